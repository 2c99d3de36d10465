// As much of rclcpp as generated nodes use. It makes nothing: it records what is asked for, and where that is written.
// What is unknown in source (ask, number, text) comes from a seed.
#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace recording {
inline unsigned state = 1;
inline int calls = 0;
inline bool is_left = false;
inline int bias = 0;
struct Endless : std::exception {};
inline unsigned next() {
  if (++calls > 4000) throw Endless();
  state = state * 1664525u + 1013904223u;
  return state >> 16;
}
struct Made { char kind; int line; std::string name; int depth; char reliability; };
inline std::vector<Made> made;
inline std::vector<std::function<void()>> later;
inline void add(char kind, int line, const std::string & name, int depth = 0, char reliability = '-') {
  if (made.size() < 200) made.push_back({kind, line, name, depth, reliability});
}
// Each run has a process of its own: what is static begins anew.
template <typename Function> void run(int program, int seed, Function function) {
  std::fflush(stdout);
  if (pid_t child = fork()) {
    waitpid(child, nullptr, 0);
    return;
  }
  const rlimit second{1, 1};
  setrlimit(RLIMIT_CPU, &second);
  state = static_cast<unsigned>(seed) * 7919u + 17u;
  bias = seed % 8;
  calls = 0;
  is_left = false;
  made.clear();
  later.clear();
  char end = 'n';
  try { function(); } catch (const std::exception &) { end = 'x'; } catch (int) { end = 'x'; }
  std::printf("R\t%d\t%d\t%c\t%d\n", program, seed, end, is_left ? 1 : 0);
  for (const Made & one : made)
    std::printf("%c\t%d\t%s\t%d\t%c\n", one.kind, one.line, one.name.c_str(), one.depth, one.reliability);
  std::fflush(stdout);
  _exit(0);
}
}  // namespace recording

// What nobody can know from source.
inline bool ask(int) {
  unsigned one = recording::next();
  if (recording::bias == 1) return true;
  if (recording::bias == 2) return false;
  return one % 2 == 0;
}
inline int number() { return recording::bias == 1 ? 2 : recording::bias == 2 ? 0 : static_cast<int>(recording::next() % 4); }
inline std::string text() { return recording::next() % 2 ? "x0" : "x1"; }
inline void risk() { if (recording::next() % 2) throw std::runtime_error("risk"); }
// Said before a function that returns nothing is left early, which evaluation takes for a failure.
inline void left() { recording::is_left = true; }

namespace std_msgs { namespace msg { struct String { std::string data; }; } }

namespace rclcpp {
class QoS {
public:
  QoS(int depth) : depth_(depth) {}
  QoS & reliable() { reliability_ = 'r'; return *this; }
  QoS & best_effort() { reliability_ = 'b'; return *this; }
  QoS & transient_local() { return *this; }
  QoS & durability_volatile() { return *this; }
  QoS & keep_last(int depth) { depth_ = depth; return *this; }
  int depth_;
  char reliability_ = 'r';
};
class SensorDataQoS : public QoS { public: SensorDataQoS() : QoS(5) { reliability_ = 'b'; } };
class SystemDefaultsQoS : public QoS { public: SystemDefaultsQoS() : QoS(0) { reliability_ = '-'; } };
template <typename T> class Publisher { public: using SharedPtr = std::shared_ptr<Publisher<T>>; };
template <typename T> class Subscription { public: using SharedPtr = std::shared_ptr<Subscription<T>>; };
class TimerBase { public: using SharedPtr = std::shared_ptr<TimerBase>; };
class Node {
public:
  using SharedPtr = std::shared_ptr<Node>;
  explicit Node(const std::string &) {}
  virtual ~Node() {}
  template <typename T> std::shared_ptr<Publisher<T>> create_publisher(
    const std::string & name, const QoS & qos, int line = __builtin_LINE()) {
    recording::add('P', line, name, qos.depth_, qos.reliability_);
    return std::make_shared<Publisher<T>>();
  }
  template <typename T, typename F> std::shared_ptr<Subscription<T>> create_subscription(
    const std::string & name, const QoS & qos, F function, int line = __builtin_LINE()) {
    recording::add('S', line, name, qos.depth_, qos.reliability_);
    recording::later.push_back([function]() mutable { function(std::make_shared<T>()); });
    return std::make_shared<Subscription<T>>();
  }
  template <typename T> T declare_parameter(const std::string & name, const T & value, int line = __builtin_LINE()) {
    recording::add('D', line, name);
    return set(value);
  }
  std::string declare_parameter(const std::string & name, const char * value, int line = __builtin_LINE()) {
    recording::add('D', line, name);
    return set(std::string(value));
  }
private:
  static bool set(bool value) { return recording::next() % 2 ? value : !value; }
  static int set(int value) { return recording::next() % 2 ? value : value + 1; }
  static std::string set(const std::string & value) { return recording::next() % 2 ? value : "set"; }
};
}  // namespace rclcpp
