#include "io/picture/picture.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "io/picture/offscreen_display.h"
#include "io/picture/picture_series.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/io/picture/picture_contents.h"

// last: it defines words like None and Status
#include <X11/Xlib.h>

namespace menger::io {
namespace {

namespace fs = std::filesystem;

/// Sets an environment variable for the time of a test.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Environment() { set(before_ ? before_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) const {
    if (value == nullptr) {
      unsetenv(name_);
    } else {
      setenv(name_, value, 1);
    }
  }

  const char* name_;
  std::optional<std::string> before_;
};

/// Whether this process has a child, ended ones that nobody waited for included.
bool has_children() {
  siginfo_t child{};
  return waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT) == 0;
}

/// A picture of one colour.
void fill_green(vtkRenderWindow& window) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.0, 1.0, 0.0);
  window.AddRenderer(renderer);
}

class Picture : public testing::Test {
 protected:
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
  fs::path file_ = folder_ / "green.png";
  PictureStyle small_{.width_px = 32, .height_px = 20};
};

TEST_F(Picture, OfASeriesShowsItsOwnScene) {
  vtkNew<vtkRenderer> renderer;
  int made = 0;
  const auto next = [&] {
    renderer->SetBackground(0.0, made == 0 ? 1.0 : 0.0, made == 1 ? 1.0 : 0.0);
    return made < 2;
  };
  const PictureOutcome outcome = draw_pictures(
      small_, [&](vtkRenderWindow& window) { window.AddRenderer(renderer); }, next,
      [&](const std::string& png) { write_whole(folder_ / (std::to_string(made++) + ".png"), png); });
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  EXPECT_EQ(PictureContents(folder_ / "0.png").count({0, 255, 0}), 32 * 20);
  EXPECT_EQ(PictureContents(folder_ / "1.png").count({0, 0, 255}), 32 * 20);
  EXPECT_FALSE(fs::exists(folder_ / "2.png"));
}

TEST_F(Picture, HasTheSizeAndTheContentAskedFor) {
  const PictureOutcome outcome = write_picture(file_, small_, fill_green);
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  const PictureContents picture(file_);
  EXPECT_EQ(picture.width(), 32);
  EXPECT_EQ(picture.height(), 20);
  EXPECT_EQ(picture.count({0, 255, 0}), 32 * 20);
}

TEST_F(Picture, ADeadDisplayIsNoReasonToAbort) {
  const Environment display("DISPLAY", ":987");
  const PictureOutcome outcome = write_picture(file_, small_, fill_green);
  EXPECT_EQ(outcome.written, fs::exists(file_));
  EXPECT_NE(outcome.written, !outcome.missing.empty());
}

TEST_F(Picture, SaysWhatIsMissingWithoutDisplayAndXvfb) {
  const Environment display("DISPLAY", nullptr);
  const Environment path("PATH", "/nowhere");
  const PictureOutcome outcome = write_picture(file_, small_, fill_green);
  EXPECT_FALSE(outcome.written);
  EXPECT_NE(outcome.missing.find("xvfb"), std::string::npos) << outcome.missing;
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Picture, LeavesNoServerBehind) {
  const Environment display("DISPLAY", nullptr);
  {
    const OffscreenDisplay virtual_display;
    if (!virtual_display.available()) GTEST_SKIP() << virtual_display.missing();
    EXPECT_TRUE(has_children());
  }
  EXPECT_FALSE(has_children());
}

// hwloc, which every mpirun asks for the cores of the machine, connects to the displays 0 to 9 to look for GPUs: a server there
// that ends while it looks would end the program, too.
TEST_F(Picture, StartsServersWhereNobodyLooksForOne) {
  const Environment display("DISPLAY", nullptr);
  const OffscreenDisplay first;
  if (!first.available()) GTEST_SKIP() << first.missing();
  const OffscreenDisplay second;  // the display of the first is taken
  ASSERT_TRUE(second.available()) << second.missing();
  const auto number = [](const OffscreenDisplay& server) {
    return std::stoi(std::string(DisplayString(static_cast<Display*>(server.connection()))).substr(1));
  };
  EXPECT_GE(number(first), 10);
  EXPECT_GE(number(second), 10);
  EXPECT_NE(number(first), number(second));
}

TEST_F(Picture, APlaceUnderAFileIsRefused) {
  write_whole(folder_ / "file", "text");
  EXPECT_THROW(static_cast<void>(write_picture(folder_ / "file/green.png", small_, fill_green)), InputError);
}

}  // namespace
}  // namespace menger::io
