#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Returns a text as it stands in HTML, in an element or in a quoted attribute.
std::string html_text(std::string_view text);

/// Returns bytes in base64.
std::string base64_text(std::string_view bytes);

/// Returns a page as one HTML file that needs no network and no other file.
///
/// Texts of the page are data and never markup: those in HTML are escaped, those in JSON have no "<", and the page's own code
/// makes text of them. Without `three` the page has no 3-D, and says that it was made so.
/// @param three the code of three.js, or nothing
std::string page_text(const ReportPage& page, const std::optional<std::string>& three);

/// The code of three.js of Debian's package libjs-three, or the reason why there is none.
struct ThreeCode {
  std::optional<std::string> code;
  std::string missing;  ///< what to install; empty if there is the code
};
ThreeCode read_three();

/// Reads it from the first of these files that is there.
ThreeCode read_three(const std::vector<std::filesystem::path>& files);

/// A file that is part of the page: "page.html", "page.css", "chart.js", "scene.js" or "page.js".
std::string_view page_source(std::string_view name);

}  // namespace menger::evolution
