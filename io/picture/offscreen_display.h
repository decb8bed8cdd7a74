#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

namespace menger::io {

/// A connection to an X display for rendering off-screen.
///
/// Uses the display of the environment variable DISPLAY if it can be reached. Otherwise starts a virtual one (Xvfb), which ends
/// with this object. VTK aborts the program where there is neither, so check `available()` before rendering.
class OffscreenDisplay {
 public:
  OffscreenDisplay();
  ~OffscreenDisplay();
  OffscreenDisplay(const OffscreenDisplay&) = delete;
  OffscreenDisplay& operator=(const OffscreenDisplay&) = delete;

  [[nodiscard]] bool available() const { return connection_ != nullptr; }

  /// Returns what is missing and how to get it; empty if a display is available.
  [[nodiscard]] const std::string& missing() const { return missing_; }

  /// Returns the connection as the `Display*` of Xlib. This object owns it.
  [[nodiscard]] void* connection() const { return connection_; }

 private:
  bool connect(const std::string& display);
  void start_server();
  /// Starts a server. @return the number of its display once it is ready; empty if the server ended or took too long
  std::string started_server(const std::string& display);
  void end_server();

  /// Waits for the server to end. @return its exit status; nothing if it has not ended in time
  std::optional<int> wait_for_end(std::chrono::milliseconds patience);

  void* connection_ = nullptr;
  pid_t server_ = -1;
  std::string missing_;
};

}  // namespace menger::io
