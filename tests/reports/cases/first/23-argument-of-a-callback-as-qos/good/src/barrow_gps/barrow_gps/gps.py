import rclpy
from std_msgs.msg import String


class Decoder:

    def __init__(self):
        self.count = 0

    def decode(self, sentence):
        self.count += sentence.startswith('$GP')


def on_sentence(msg, decoder):
    decoder.decode(msg.data)


def main():
    rclpy.init()
    node = rclpy.create_node('gps')
    decoder = Decoder()
    node.create_subscription(String, 'sentence', lambda msg: on_sentence(msg, decoder), 10)
    rclpy.spin(node)
    rclpy.shutdown()
