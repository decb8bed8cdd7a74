#include "evolution/reevaluation/reevaluation_output.h"

#include <system_error>

#include "evolution/reevaluation/reevaluation_chart.h"
#include "evolution/reevaluation/reevaluation_scene.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// Removes what is of no use beside other results: files of earlier calls that this one may not write.
void remove_earlier(const fs::path& folder) {
  std::vector<fs::path> files{folder / "reevaluation_judge.csv", folder / "reevaluation.png", folder / "manifest.json",
                              folder / "winner/trajectories.png"};
  std::error_code no_such_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "trajectories", no_such_folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("rank_") && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  for (const fs::path& file : files) io::remove_if_there(file);
}

std::string rank_file(std::size_t rank) { return "rank_" + io::padded(rank, 4) + ".csv"; }

void note_missing(const std::string& file, const io::PictureOutcome& picture, std::vector<std::string>& notes) {
  if (!picture.written && !picture.missing.empty()) notes.push_back(file + ": not drawn: " + picture.missing);
}

void write_winner(const ReevaluationStudy& study, const fs::path& folder, bool pictures, const JudgedDesign& winner,
                  std::vector<std::string>& notes) {
  meshes::write_design(folder / "design.toml", design_of(study, winner.design.body));
  if (pictures) {
    note_missing(
        "trajectories.png",
        io::write_chart(folder / "trajectories.png", trajectories_chart(study, winner), {.width_px = 2100, .height_px = 750}),
        notes);
  }
  try {
    const SceneOutcome scene = write_both_models(folder, winner, pictures);
    notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
    if (pictures) note_missing("strip.png", scene.picture, notes);
  } catch (const io::InputError& error) {  // frames that are gone or damaged take nothing from the numbers
    notes.push_back(std::string("the winner is not shown in both models: ") + error.what());
  }
}

}  // namespace

void write_reevaluation(const ReevaluationStudy& study, const fs::path& folder, bool pictures,
                        const ReevaluationFindings& findings, std::vector<std::string>& notes) {
  remove_earlier(folder);
  reevaluation_table(study, findings).write(folder / "reevaluation.csv");
  refused_table(findings).write(folder / "refused.csv");
  if (!findings.variants.empty()) judge_table(study, findings).write(folder / "reevaluation_judge.csv");
  ranking_table(findings).write(folder / "ranking.csv");
  io::write_whole(folder / "summary.txt", findings_text(study, findings));
  for (const JudgedDesign& design : findings.designs)
    trajectory_comparison(design).write(folder / "trajectories" / rank_file(design.design.rank));
  write_winner(study, folder / "winner", pictures, findings.designs.front(), notes);
  if (!pictures) return;
  const io::PictureStyle style{.width_px = 2000, .height_px = 900};
  note_missing("reevaluation.png", io::write_chart(folder / "reevaluation.png", scatter_chart(study, findings), style), notes);
}

}  // namespace menger::evolution
