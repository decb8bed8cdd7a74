#include "evolution/page/walk_animation.h"

#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <system_error>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "evolution/page/body_frames.h"
#include "io/picture/picture_series.h"
#include "io/picture/scale_bar.h"
#include "io/process/child_program.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/walk_agreement.h"
#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using BodyColour = std::array<unsigned char, 3>;

constexpr io::PictureStyle animation_style{.width_px = 720, .height_px = 440};
constexpr std::array<BodyColour, 2> body_colours{{{222, 205, 172}, {140, 178, 214}}};

std::string reason_of(int error) { return std::generic_category().message(error); }

/// A folder for pictures that are joined, which ends with this object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    if (error) throw io::InputError("TMPDIR: pictures of an animation cannot be kept: " + error.message());
    std::string pattern = (folder / "menger-animation-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw io::InputError(folder.string() + ": pictures of an animation cannot be kept here: " + reason_of(errno));
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Where a time lies among frames: the frame before it and the share of the way to the next one.
std::pair<std::size_t, double> place_in_time(const PageBody& body, double time) {
  const auto after = std::ranges::upper_bound(body.times, time);
  if (after == body.times.begin() || body.times.size() < 2) return {0, 0.0};
  if (after == body.times.end()) return {body.times.size() - 2, 1.0};
  const auto n = static_cast<std::size_t>(after - body.times.begin()) - 1;
  return {n, (time - body.times[n]) / (body.times[n + 1] - body.times[n])};
}

vtkSmartPointer<vtkPolyData> surface_at(const PageBody& body, double time, std::size_t number) {
  const auto [frame, share] = place_in_time(body, time);
  const std::size_t next = std::min(frame + 1, body.times.size() - 1);
  vtkNew<vtkPoints> points;
  for (std::size_t c = 0; c < body.corners; ++c) {
    const std::array<double, 3> a = corner_m(body, frame, c);
    const std::array<double, 3> b = corner_m(body, next, c);
    points->InsertNextPoint(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2]));
  }
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const auto& face = body.faces[f];
    const int count = face[3] == face[2] ? 3 : 4;
    cells->InsertNextCell(count);
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) cells->InsertCellPoint(static_cast<vtkIdType>(face.at(n)));
    const bool has_material = !body.materials.empty() && (body.materials[f] == 1 || body.materials[f] == 2);
    const BodyColour& colour =
        has_material ? voxel::material_colours.at(body.materials[f] - 1U) : body_colours.at(number % body_colours.size());
    colours->InsertNextTypedTuple(colour.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  surface->GetCellData()->SetScalars(colours);
  return surface;
}

/// ": 12.3 mm", ": 12.3 mm (ended at 2 s)": how far a body has come; without the way if it is not known.
std::string way_text(const PageBody& body, double time) {
  std::string text;
  if (body.travelled_m.size() == body.times.size()) {
    const auto [frame, share] = place_in_time(body, time);
    const std::size_t next = std::min(frame + 1, body.times.size() - 1);
    const double way_m = body.travelled_m[frame] + share * (body.travelled_m[next] - body.travelled_m[frame]);
    text = ": " + io::formatted("%.1f mm", 1e3 * way_m);
  }
  const double end = body.times.back();
  if (time > end && !meshes::last_as_long(time, end)) text += " (ended at " + io::shown(end, 3) + " s)";
  return text;
}

/// Draws the pictures of a walk.
class WalkPictures {
 public:
  explicit WalkPictures(const PageScene& scene) : scene_(scene), view_(voxel::isometric_view()) {
    for (const PageBody& body : scene.bodies) {
      from_ = std::min(from_, body.times.front());
      to_ = std::max(to_, body.times.back());
      for (std::size_t frame = 0; frame < body.times.size(); ++frame) {
        const auto [low, high] = box_of(body, frame);
        for (const double x : {low[0], high[0]}) {
          for (const double y : {low[1], high[1]}) {
            for (const double z : {low[2], high[2]}) {
              world_.add({x, y, z});
              seen_.add(view_.coordinates({x, y, z}));
            }
          }
        }
      }
    }
    pace_ = pace_of(to_ - from_, (to_ - from_) * scene.frequency_Hz.value_or(0.0));
  }

  [[nodiscard]] const AnimationPace& pace() const { return pace_; }

  void fill(vtkRenderWindow& window) {
    renderer_->SetBackground(1.0, 1.0, 1.0);
    window.AddRenderer(renderer_);
    voxel::add_light(*renderer_);
  }

  void draw(std::size_t picture) {
    const double time =
        from_ + (to_ - from_) * static_cast<double>(picture) / static_cast<double>(std::max<std::size_t>(1, pace_.pictures - 1));
    renderer_->RemoveAllViewProps();
    const double size = std::max({world_.size(0), world_.size(1), world_.size(2)});
    const double ground_m = scene_.ground_m.value_or(world_.low[2]);
    const auto below = [&](int layers) { return ground_m - 0.001 * layers * size; };
    voxel::Extent floor = world_;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      floor.low.at(axis) -= 0.25 * size;
      floor.high.at(axis) += 0.25 * size;
    }
    voxel::add_floor(*renderer_, floor, below(4));
    for (std::size_t n = 0; n < scene_.bodies.size(); ++n) {
      const PageBody& body = scene_.bodies[n];
      const vtkSmartPointer<vtkPolyData> surface = surface_at(body, time, n);
      voxel::add_shadow(*renderer_, *surface, ground_m, below(3));
      voxel::add_trail(*renderer_, trail_of(body, time, below(2)));
      voxel::add_robot(*renderer_, *surface, 1.0);
    }
    const double bar_m = io::scale_bar_length(0.3 * std::max(world_.size(0), world_.size(1)));
    const voxel::Vector begin{floor.low[0], floor.low[1], below(1)};
    voxel::add_trail(*renderer_, std::vector<voxel::Vector>{begin, {begin[0] + bar_m, begin[1], begin[2]}});
    const std::string caption = walk_caption(scene_, time, pace_, bar_m);
    voxel::add_caption(*renderer_, caption, 0.5, caption_size(caption.size()));
    voxel::Extent seen = seen_;
    for (const double x : {floor.low[0], floor.high[0]})
      for (const double y : {floor.low[1], floor.high[1]}) seen.add(view_.coordinates({x, y, ground_m}));
    voxel::aim(*renderer_, view_, seen, static_cast<double>(animation_style.width_px) / animation_style.height_px, 0.03);
  }

 private:
  [[nodiscard]] static std::vector<voxel::Vector> trail_of(const PageBody& body, double time, double height) {
    std::vector<voxel::Vector> trail;
    for (std::size_t n = 0; n < body.times.size() && body.times[n] <= time; ++n)
      trail.push_back({body.centres_m[n][0], body.centres_m[n][1], height});
    return trail;
  }

  const PageScene& scene_;
  voxel::View view_;
  voxel::Extent world_;
  voxel::Extent seen_;
  double from_ = std::numeric_limits<double>::max();
  double to_ = std::numeric_limits<double>::lowest();
  AnimationPace pace_;
  vtkNew<vtkRenderer> renderer_;
};

}  // namespace

std::string walk_caption(const PageScene& scene, double time, const AnimationPace& pace, double bar_m) {
  std::string text;
  const std::vector<PageBody>& bodies = scene.bodies;
  if (bodies.size() == 2)
    text = bodies[0].name + " behind" + way_text(bodies[0], time) + ", " + bodies[1].name + " in front" +
           way_text(bodies[1], time) + ", ";
  if (scene.angle_deg) text += io::degrees(*scene.angle_deg) + " apart at the end, ";
  if (bodies.size() == 1) text = bodies[0].name + way_text(bodies[0], time) + ", ";
  text += io::formatted("%.2f s", time);
  if (pace.slower > 1) text += ", shown " + std::to_string(pace.slower) + " times slower";
  if (pace.pictures_per_stroke && !shows_strokes(*pace.pictures_per_stroke))
    text += ", " + io::shown(*pace.pictures_per_stroke, 2) + " pictures in a stroke";
  return text + ", bar " + io::shown(1e3 * bar_m) + " mm";
}

int caption_size(std::size_t letters) {
  constexpr double usual = 15.0;
  constexpr double fitting = 92.0;  // letters of the usual size across a picture
  return static_cast<int>(std::floor(usual * std::min(1.0, fitting / static_cast<double>(std::max<std::size_t>(1, letters)))));
}

AnimationPace pace_of(double duration_s, double strokes) {
  constexpr double least_s = 4.0;
  constexpr double usual_per_s = 12.5;
  constexpr double most_per_s = 25.0;  // pictures of a GIF last whole hundredths of a second
  constexpr double most_pictures = 250.0;
  AnimationPace pace;
  const double of_strokes = std::min(std::ceil(least_per_stroke * strokes), most_pictures);
  const auto shown_s = [&] { return duration_s * pace.slower; };
  while (pace.slower < 8 && (shown_s() < least_s || of_strokes > most_per_s * shown_s())) pace.slower *= 2;
  const double most = std::clamp(std::floor(most_per_s * shown_s()), 2.0, most_pictures);
  const double pictures = std::clamp(std::max(std::ceil(usual_per_s * shown_s()), of_strokes), 2.0, most);
  pace.pictures = static_cast<std::size_t>(pictures);
  pace.pictures_per_s = shown_s() > 0.0 ? std::min(pictures / shown_s(), most_per_s) : usual_per_s;
  if (strokes > 0.0) pace.pictures_per_stroke = pictures / strokes;
  return pace;
}

std::optional<fs::path> find_ffmpeg() {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nothing changes the environment
  std::string_view folders = path == nullptr ? "/usr/bin" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const fs::path file = fs::path(folders.substr(0, end)) / "ffmpeg";
    if (end > 0 && io::is_file(file) && ::access(file.c_str(), X_OK) == 0) return file;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return std::nullopt;
}

AnimationOutcome write_walk_animation(const fs::path& file, const PageScene& scene, const std::optional<fs::path>& ffmpeg,
                                      const std::atomic<bool>* stop, const std::function<void(double share)>& progress) {
  if (!ffmpeg) return {.missing = "ffmpeg is missing: install the package ffmpeg"};
  WalkPictures pictures(scene);
  const ScratchFolder scratch;
  std::size_t drawn = 0;
  const auto is_stopped = [&] { return stop != nullptr && *stop; };
  const io::PictureOutcome outcome = io::draw_pictures(
      animation_style, [&](vtkRenderWindow& window) { pictures.fill(window); },
      [&] {
        if (drawn >= pictures.pace().pictures || is_stopped()) return false;
        pictures.draw(drawn);
        return true;
      },
      [&](const std::string& png) {
        io::write_whole(scratch.path() / ("frame_" + io::padded(drawn++, 4) + ".png"), png);
        if (progress) progress(0.9 * static_cast<double>(drawn) / static_cast<double>(pictures.pace().pictures));
      });
  if (!outcome.written) return {.missing = outcome.missing};
  if (is_stopped()) return {.stopped = true};
  io::PendingFile target(file);
  const fs::path log = scratch.path() / "ffmpeg.log";
  const io::ChildOutcome joined = io::run_child(
      {.program = *ffmpeg,
       .arguments =
           {"-nostdin", "-loglevel", "error", "-framerate", io::formatted("%.6g", pictures.pace().pictures_per_s), "-i",
            "frame_%04d.png", "-vf",
            "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle",
            "-loop", "0", "-y", fs::absolute(target.temporary()).string()},
       .folder = scratch.path(),
       .out = log,
       .err = log,
       .stop = stop});
  if (is_stopped()) return {.stopped = true};
  if (joined.exit_code != 0) return {.missing = ffmpeg->string() + " failed: " + io::read_start(log, 400)};
  target.commit();
  return {.written = true};
}

}  // namespace menger::evolution
