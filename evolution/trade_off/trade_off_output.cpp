#include "evolution/trade_off/trade_off_output.h"

#include <cmath>
#include <string>

#include "evolution/trade_off/trade_off_chart.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

void draw(const io::Chart& chart, const fs::path& file, TradeResult& result) {
  const auto outcome = io::write_chart(file, chart);
  if (!outcome.written) result.notes.push_back(file.filename().string() + ": not drawn: " + outcome.missing);
}

/// What tables have in common.
struct Sections {
  io::Chart chart{};
  std::string text{};
  std::string toml{};

  void add(const TradeTable& table, const std::string& title, const std::vector<double>& targets, const std::string& key) {
    chart.panels.push_back(trade_panel(table, title));
    text.append(text.empty() ? "" : "\n").append(title).append("\n").append(recommendation_text(table, targets));
    toml.append(toml.empty() ? "" : "\n").append(recommendation_toml(table, targets, key));
  }
};

}  // namespace

void write_trade(const TradeStudy& study, const fs::path& folder, bool pictures, TradeResult& result) {
  Sections sections;
  if (result.body) {
    trade_csv(*result.body).write(folder / "tradeoff.csv");
    const std::string pressure = io::number_text(std::round(result.pressure_Pa) / 1e3) + " kPa";
    sections.add(*result.body, study.design.name + " at " + pressure, study.targets, "recommendation");
  }
  if (result.gait) {
    trade_csv(*result.gait).write(folder / "gait.csv");
    sections.add(*result.gait, study.design.name + " walking, voxels alone", study.targets, "gait_recommendation");
  }
  if (result.body || result.gait) {
    io::write_whole(folder / "recommendation.txt", sections.text);
    io::write_whole(folder / "recommendation.toml", sections.toml);
    if (pictures) draw(sections.chart, folder / "tradeoff.png", result);
  }
  if (result.search) {
    search_csv(*result.search).write(folder / "search.csv");
    io::write_whole(folder / "search.txt", search_text(*result.search));
    if (pictures) draw(search_chart(*result.search), folder / "search.png", result);
  }
}

}  // namespace menger::evolution
