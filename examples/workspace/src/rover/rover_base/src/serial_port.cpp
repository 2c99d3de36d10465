#include "rover_base/serial_port.hpp"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>

namespace rover_base
{

static speed_t speed_of(int baud)
{
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    default:
      return B0;
  }
}

SerialPort::~SerialPort()
{
  close();
}

bool SerialPort::open(const std::string & device, int baud)
{
  close();
  const speed_t speed = speed_of(baud);
  if (speed == B0) {
    return false;
  }
  const int descriptor = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (descriptor < 0) {
    return false;
  }
  termios options{};
  if (tcgetattr(descriptor, &options) != 0) {
    ::close(descriptor);
    return false;
  }
  cfmakeraw(&options);
  options.c_cflag |= CLOCAL | CREAD;
  options.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  options.c_cc[VMIN] = 0;
  options.c_cc[VTIME] = 0;
  cfsetispeed(&options, speed);
  cfsetospeed(&options, speed);
  if (tcsetattr(descriptor, TCSANOW, &options) != 0) {
    ::close(descriptor);
    return false;
  }
  descriptor_ = descriptor;
  return true;
}

void SerialPort::close()
{
  if (descriptor_ >= 0) {
    ::close(descriptor_);
    descriptor_ = -1;
  }
}

std::vector<std::uint8_t> SerialPort::read()
{
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 256> buffer;
  while (is_open()) {
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count <= 0) {
      if (count < 0 && errno == EINTR) {
        continue;
      }
      break;
    }
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + count);
  }
  return bytes;
}

bool SerialPort::write(const std::vector<std::uint8_t> & bytes)
{
  std::size_t written = 0;
  while (is_open() && written < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (count < 0) {
      if (errno == EINTR || errno == EAGAIN) {
        continue;
      }
      return false;
    }
    written += static_cast<std::size_t>(count);
  }
  return is_open();
}

}  // namespace rover_base
