#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"
#include "fem/locomotion/locomotion_study.h"

namespace menger::evolution {

/// A file of a body at some time.
struct BodyFrame {
  double time = 0.0;
  std::filesystem::path file;
};

/// The files of a ParaView collection, by the number of their part, in order of time.
struct BodyFrames {
  int part = 0;
  std::vector<BodyFrame> frames;
};

/// Reads a collection (.pvd). @param folder the results that the collection belongs to
/// @throws io::InputError if it cannot be read or is no collection, or if it names a file that lies, after all links, outside the
/// folder
std::vector<BodyFrames> read_body_frames(const std::filesystem::path& collection, const std::filesystem::path& folder);

/// What a body of the page is made from.
struct BodyRequest {
  std::string name;  ///< of the body in its scene
  std::vector<BodyFrame> frames;
  std::size_t most_bytes = 0;                          ///< that surface and positions may take; frames are left out to keep to it
  std::size_t most_frames = fem::most_frames_of_walk;  ///< likewise
  bool has_phases = true;                              ///< false: all cells are driven at once, and materials mean nothing
  std::optional<ManifestBody> body;                    ///< whose cells give the materials, for files without them
  /// The edge of a cell of a body that floats free: it is shown as if held at its near end (see motion_of_near_end).
  std::optional<double> held_cell_m{};
};

/// Reads the outer surface of a body at its times. Positions are those of the deformed body: where the points of all files are
/// the same, `displacement_m` is added to them.
///
/// Walls of chambers inside the body are left out. Cells may be hexahedra, also quadratic ones, or the polygons of a surface.
/// The files are read in a child process, since a damaged one can end VTK.
/// @throws io::InputError if a file cannot be read or is damaged, if the files are not of one mesh, or if two frames take more
/// than most_bytes
PageBody read_page_body(const BodyRequest& request);

/// Returns which of some frames are shown: at most `most`, evenly spaced, with the first and the last.
std::vector<std::size_t> shown_frames(std::size_t count, std::size_t most);

/// Returns the position of a corner in a frame.
std::array<double, 3> corner_m(const PageBody& body, std::size_t frame, std::size_t corner);

/// Returns the smallest box along the axes around a frame: the lowest and the highest coordinates.
std::pair<std::array<double, 3>, std::array<double, 3>> box_of(const PageBody& body, std::size_t frame);

}  // namespace menger::evolution
