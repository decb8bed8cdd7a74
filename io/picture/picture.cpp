#include "io/picture/picture.h"

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "io/picture/offscreen_display.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace menger::io {

PictureOutcome write_picture(const std::filesystem::path& file, const PictureStyle& style,
                             const std::function<void(vtkRenderWindow&)>& fill) {
  require_writable_folder(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
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
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
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
  if (writer->GetErrorCode() != 0) throw InputError(file.string() + ": VTK cannot write it");
  vtkUnsignedCharArray& bytes = *writer->GetResult();
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): a picture is bytes
  const std::string_view content(reinterpret_cast<const char*>(bytes.GetPointer(0)),
                                 static_cast<std::size_t>(bytes.GetNumberOfValues()));
  window->Finalize();
  write_whole(file, content);
  return {.written = true, .missing = {}};
}

}  // namespace menger::io
