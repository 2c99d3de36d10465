"""ROS 1 observed by its own protocols, XML-RPC and TCPROS; nothing of ROS is imported."""
