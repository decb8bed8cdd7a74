#include "io/picture/picture.h"

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <utility>

#include "io/picture/offscreen_display.h"
#include "io/picture/picture_series.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace menger::io {
namespace {

/// What a window shows, as the bytes of a PNG file of the size without supersampling.
std::string png_of(vtkRenderWindow& window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> smooth;
  smooth->SetInputConnection(image->GetOutputPort());
  smooth->SetShrinkFactors(supersampling, supersampling, 1);
  smooth->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(smooth->GetOutputPort());
  // The picture is made in memory: on a full disk, the library would print its own errors.
  writer->WriteToMemoryOn();
  writer->Write();
  if (writer->GetErrorCode() != 0) throw InputError("a picture: VTK cannot write it");
  vtkUnsignedCharArray& bytes = *writer->GetResult();
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): a picture is bytes
  return {reinterpret_cast<const char*>(bytes.GetPointer(0)), static_cast<std::size_t>(bytes.GetNumberOfValues())};
}

}  // namespace

PictureOutcome draw_pictures(const PictureStyle& style, const std::function<void(vtkRenderWindow&)>& fill,
                             const std::function<bool()>& next, const std::function<void(const std::string& png)>& done) {
#ifdef __SANITIZE_ADDRESS__
  // Graphics drivers never free some memory and are then unloaded, so that a leak check cannot find its owner.
  const __lsan::ScopedDisabler no_leak_check;
#endif
  const OffscreenDisplay display;
  if (!display.available()) return {.missing = display.missing()};

  vtkNew<vtkRenderWindow> window;
  window->SetDisplayId(display.connection());
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  if (window->SupportsOpenGL() == 0) return {.missing = "the X display has no OpenGL 3.2: install the package libgl1-mesa-dri"};
  window->SetSize(supersampling * style.width_px, supersampling * style.height_px);
  fill(*window);
  while (next()) {
    window->Render();
    done(png_of(*window));
  }
  window->Finalize();
  return {.written = true, .missing = {}};
}

PictureOutcome write_picture(const std::filesystem::path& file, const PictureStyle& style,
                             const std::function<void(vtkRenderWindow&)>& fill) {
  require_writable_folder(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
  bool is_drawn = false;
  std::string content;
  PictureOutcome outcome = draw_pictures(
      style, fill, [&] { return !std::exchange(is_drawn, true); }, [&](const std::string& png) { content = png; });
  if (outcome.written) write_whole(file, content);
  return outcome;
}

}  // namespace menger::io
