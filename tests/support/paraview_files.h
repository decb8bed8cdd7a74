#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "io/text/whole_file.h"

namespace menger::test_support {

/// Returns why ParaView cannot open a file of VTK's XML formats; empty if it can. It checks for errors that programs can make:
/// data in an appended section (see io::write_vtu), data that are not compressed or are written as digits, and files that a
/// collection or a parallel file names but that do not exist.
inline std::string why_paraview_refuses(const std::filesystem::path& file) {
  const std::string text = io::read_whole(file);
  if (text.find("<VTKFile") == std::string::npos) return "it is no XML file of VTK";
  for (const char* appended : {"<AppendedData", "format=\"appended\""})
    if (text.find(appended) != std::string::npos) return std::string("it holds ") + appended;
  // The end of a start tag is the first '>', because writers of VTK escape it in names.
  bool has_data = false;
  for (std::size_t at = text.find("Array "); at != std::string::npos; at = text.find("Array ", at + 1)) {
    if (text[text.rfind('<', at) + 1] == 'P') continue;  // in a parallel file: describes an array and holds no data
    const std::string tag = text.substr(at, text.find('>', at) - at);
    if (tag.find("format=\"binary\"") == std::string::npos) return "it has an array that is not binary: " + tag;
    has_data = true;
  }
  if (has_data && text.find("compressor=\"vtkZLibDataCompressor\"") == std::string::npos) return "its data are not compressed";
  for (const std::string_view attribute : {" file=\"", " Source=\""}) {
    for (std::size_t at = text.find(attribute); at != std::string::npos; at = text.find(attribute, at + 1)) {
      const std::size_t begin = at + attribute.size();
      const std::string member = text.substr(begin, text.find('"', begin) - begin);
      if (!std::filesystem::is_regular_file(file.parent_path() / member)) return "its member " + member + " is not there";
    }
  }
  return {};
}

/// Expects that a folder, with its subfolders, holds at least one file for ParaView, and that ParaView can open all of them.
inline void expect_opens_in_paraview(const std::filesystem::path& folder) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (!extension.starts_with(".vt") && !extension.starts_with(".pv")) continue;
    EXPECT_EQ(why_paraview_refuses(entry.path()), "") << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0U) << "nothing for ParaView in " << folder;
}

}  // namespace menger::test_support
