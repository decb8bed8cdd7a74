// menger compare-searches a b c: compares the results of searches on finite elements, and their costs.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/reevaluation/search_comparison.h"
#include "io/process/exit_code.h"
#include "io/process/program.h"
#include "io/process/run_folder.h"
#include "io/text/input_error.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  std::vector<fs::path> searches;
  fs::path folder = "comparison";
  ComparisonOptions options;
  bool no_pictures = false;
};

constexpr const char* description =
    "Compares searches by their best robot on finite elements, as a re-evaluation finds it, and by their cost in steps.";

constexpr const char* example =
    "Example:\n"
    "  for model in voxels elements; do\n"
    "    menger export $model.sqlite -o $model --levels 1\n"
    "    menger reevaluate $model.sqlite --top 16 -o $model/reevaluated\n"
    "  done\n"
    "  menger compare-searches voxels elements -o comparison\n"
    "writes comparison.csv, comparison.png, summary.txt and manifest.json.\n"
    "Exit codes: 0 done, 2 wrong input.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger compare-searches");
  app.footer(example);
  app.add_option("searches", arguments.searches, "Folders of results, one per search")->required();
  app.add_option("-o,--output", arguments.folder, "Folder of the comparison")->capture_default_str();
  app.add_option("--budget-element-steps", arguments.options.budget_element_steps,
                 "Budget of element-steps of each re-evaluation; the first robot that exceeds it and all later ones are left out")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--voxel-steps-per-element-step", arguments.options.voxel_steps_per_element_step,
                 "Cost of an element-step in voxel-steps")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--no-pictures", arguments.no_pictures, "No PNG files");
  return io::parse_arguments(app, argc, argv);
}

/// The options and the folders, in their order, as TOML.
std::string parameters_text(const Arguments& arguments) {
  io::TomlText text;
  std::vector<std::string> folders;
  for (const fs::path& folder : arguments.searches) folders.push_back(folder.string());
  text.add("searches", folders).add("voxel_steps_per_element_step", arguments.options.voxel_steps_per_element_step);
  if (std::isfinite(arguments.options.budget_element_steps))
    text.add("budget_element_steps", arguments.options.budget_element_steps);
  return text.text();
}

int compare(const Arguments& arguments) {
  const io::RunFolder folder("menger-compare-searches", arguments.folder);
  std::vector<ComparedSearch> searches;
  for (const fs::path& one : arguments.searches) searches.push_back(read_compared_search(one, arguments.options));
  io::require_writable_folder(arguments.folder);
  const std::string text = comparison_text(searches, arguments.options);
  folder.begin({"comparison.csv", "comparison.png", "summary.txt"});
  comparison_table(searches, arguments.options).write(folder.file("comparison.csv"));
  io::write_whole(folder.file("summary.txt"), text);
  if (!arguments.no_pictures) {
    const io::PictureOutcome picture =
        io::write_chart(folder.file("comparison.png"), comparison_chart(searches), {.width_px = 2000, .height_px = 900});
    if (!picture.written) std::cout << "note: comparison.png: not drawn: " << picture.missing << "\n";
  }
  std::map<std::string, std::string> inputs;
  for (const ComparedSearch& search : searches) inputs.insert(search.inputs.begin(), search.inputs.end());
  folder.finish(parameters_text(arguments), inputs);
  std::cout << text << "results in " << arguments.folder.string() << std::endl;
  return io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-compare-searches", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return compare(arguments);
  });
}
