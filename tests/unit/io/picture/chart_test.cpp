#include "io/picture/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/io/picture/picture_contents.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

constexpr Colour white{255, 255, 255};

ChartSeries line_of(const std::string& name, double slope, std::size_t points = 11) {
  ChartSeries series{.name = name};
  for (std::size_t i = 0; i < points; ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(slope * static_cast<double>(i));
  }
  return series;
}

class ChartPicture : public testing::Test {
 protected:
  /// Nothing where there is no display to draw on.
  std::optional<PictureContents> draw(const Chart& chart) {
    const PictureOutcome outcome = write_chart(file_, chart, small_);
    EXPECT_NE(outcome.written, !outcome.missing.empty());
    if (!outcome.written) return std::nullopt;
    return std::optional<PictureContents>(std::in_place, file_);
  }

  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
  fs::path file_ = folder_ / "chart.png";
  PictureStyle small_{.width_px = 480, .height_px = 300};
};

TEST_F(ChartPicture, DrawsEverySeriesInItsColourOnWhite) {
  ChartPanel panel{.x = {.title = "volume (ml)"}, .y = {.title = "pressure (kPa)"}};
  for (int i = 0; i < 4; ++i) panel.series.push_back(line_of("law " + std::to_string(i), 1.0 + i));
  panel.series[3].colour = chart_ink;
  const auto picture = draw({.title = "four laws", .panels = {panel}});
  if (!picture) GTEST_SKIP() << "no display";
  EXPECT_EQ(picture->width(), 480);
  EXPECT_EQ(picture->height(), 300);
  EXPECT_GT(picture->count(white), 480 * 300 / 2);
  // The line alone crosses hundreds of pixels, of which one in three is covered whole.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GT(picture->count(chart_colour(i)), 100) << i;
  EXPECT_GT(picture->count(chart_ink), 100);
  EXPECT_EQ(picture->count(chart_colour(3)), 0);
}

TEST_F(ChartPicture, PutsPanelsSideBySide) {
  ChartPanel left{.x = {.title = "x"}, .y = {.title = "y"}, .series = {line_of("", 1.0)}};
  ChartPanel right = left;
  right.series[0].colour = chart_colour(1);
  const auto picture = draw({.panels = {left, right}});
  if (!picture) GTEST_SKIP() << "no display";
  EXPECT_GT(picture->count(chart_colour(0), 0, 240), 100);
  EXPECT_EQ(picture->count(chart_colour(0), 240, 480), 0);
  EXPECT_EQ(picture->count(chart_colour(1), 0, 240), 0);
  EXPECT_GT(picture->count(chart_colour(1), 240, 480), 100);
}

TEST_F(ChartPicture, DashesTakeFewerPixelsThanALine) {
  ChartPanel panel{.series = {line_of("", 1.0)}};
  const auto whole = draw({.panels = {panel}});
  if (!whole) GTEST_SKIP() << "no display";
  const int solid = whole->count(chart_colour(0));
  panel.series[0].dashed = true;
  const int dashed = draw({.panels = {panel}})->count(chart_colour(0));
  EXPECT_LT(dashed, 0.8 * solid);
  EXPECT_GT(dashed, 0.3 * solid);
}

TEST_F(ChartPicture, LeavesAGapAtAPointThatIsNotFinite) {
  ChartPanel panel{.series = {line_of("", 1.0)}};
  const auto whole = draw({.panels = {panel}});
  if (!whole) GTEST_SKIP() << "no display";
  panel.series[0].y[5] = std::numeric_limits<double>::quiet_NaN();
  const auto broken = draw({.panels = {panel}});
  // Two of ten segments are gone.
  EXPECT_NEAR(broken->count(chart_colour(0)), 0.8 * whole->count(chart_colour(0)), 0.05 * whole->count(chart_colour(0)));
}

TEST_F(ChartPicture, DrawsAPowerLawOnLogarithmicAxesAsAStraightLine) {
  ChartPanel panel{.x = {.logarithmic = true}, .y = {.logarithmic = true}};
  ChartSeries bent{.name = ""};
  for (int i = 0; i <= 40; ++i) {
    bent.x.push_back(std::pow(10.0, 0.1 * i));
    bent.y.push_back(std::pow(bent.x.back(), -2.0));
  }
  panel.series = {bent};
  const auto drawn = draw({.panels = {panel}});
  if (!drawn) GTEST_SKIP() << "no display";
  // A straight line between its ends covers the same pixels.
  panel.series[0].x = {bent.x.front(), bent.x.back()};
  panel.series[0].y = {bent.y.front(), bent.y.back()};
  const auto straight = draw({.panels = {panel}});
  int different = 0;
  for (int x = 0; x < drawn->width(); ++x) {
    for (int y = 0; y < drawn->height(); ++y)
      different += drawn->has_colour(x, y, chart_colour(0)) != straight->has_colour(x, y, chart_colour(0)) ? 1 : 0;
  }
  EXPECT_LT(different, 0.05 * straight->count(chart_colour(0)));
}

TEST_F(ChartPicture, NamesMarkersInTheLegendAndNotOnTheirLine) {
  ChartPanel panel{.series = {line_of("", 1.0)},
                   .markers = {{.at = 5.0}, {.direction = ChartMarker::Direction::vertical, .at = 6.0}}};
  const auto bare = draw({.panels = {panel}});
  if (!bare) GTEST_SKIP() << "no display";
  for (ChartMarker& marker : panel.markers) marker.label = "limit";
  const auto named = draw({.panels = {panel}});
  EXPECT_LT(named->count(white, 0, 240), bare->count(white, 0, 240)) << "the legend, at the top on the left";
  EXPECT_EQ(named->count(white, 240, 480), bare->count(white, 240, 480)) << "nothing is written along the lines";
}

TEST_F(ChartPicture, RefusesWhatCannotStandOnALogarithmicAxis) {
  write_whole(file_, "before");
  for (const double bad : {0.0, -1.0}) {
    ChartPanel panel{.y = {.logarithmic = true}, .series = {line_of("error", 1.0)}};
    panel.series[0].y = {1.0, 2.0, 3.0, bad, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0};
    try {
      static_cast<void>(write_chart(file_, {.panels = {panel}}, small_));
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()),
                file_.string() + ": series \"error\": y = " + (bad == 0.0 ? "0" : "-1") + ": must be > 0 on a logarithmic axis");
    }
  }
  ChartPanel panel{.x = {.logarithmic = true}, .markers = {{.direction = ChartMarker::Direction::vertical, .at = 0.0}}};
  EXPECT_THROW(static_cast<void>(write_chart(file_, {.panels = {panel}}, small_)), InputError);
  EXPECT_EQ(read_whole(file_), "before");
}

TEST_F(ChartPicture, DrawsAPanelWithoutPoints) {
  const auto picture = draw({.panels = {{.x = {.title = "x"}}, {.y = {.logarithmic = true}}}});
  if (!picture) GTEST_SKIP() << "no display";
  EXPECT_GT(picture->count(white), 480 * 300 / 2);
  EXPECT_LT(picture->count(white), 480 * 300);
}

TEST(ChartColours, AreTwelveDifferentOnesThatRepeat) {
  std::set<Colour> colours;
  for (std::size_t i = 0; i < 12; ++i) colours.insert(chart_colour(i));
  EXPECT_EQ(colours.size(), 12U);
  EXPECT_EQ(chart_colour(12), chart_colour(0));
}

}  // namespace
}  // namespace menger::io
