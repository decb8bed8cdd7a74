#include "evolution/page/page_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "evolution/verdict/verdict.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/printable.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Six digits: more are not seen, and take space.
json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0;
  const double power = std::pow(10.0, 5.0 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(power) && power > 0.0 ? std::round(value * power) / power : value;
}

json rounded(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

const char* word_of(PageMarks marks) {
  switch (marks) {
    case PageMarks::line:
      return "line";
    case PageMarks::points:
      return "points";
    case PageMarks::line_and_points:
      return "line and points";
  }
  return "line";
}

json json_of(const PageChart& chart) {
  json series = json::array();
  for (const PageSeries& one : chart.series) {
    series.push_back({{"name", one.name},
                      {"x", rounded(one.x)},
                      {"y", rounded(one.y)},
                      {"marks", word_of(one.marks)},
                      {"dashed", one.dashed},
                      {"material", one.material},
                      {"labels", one.labels}});
  }
  json markers = json::array();
  for (const PageMarker& marker : chart.markers)
    markers.push_back({{"vertical", marker.vertical}, {"at", rounded(marker.at)}, {"label", marker.label}});
  const auto axis = [](const PageAxis& one) { return json{{"title", one.title}, {"log", one.logarithmic}}; };
  return {{"title", chart.title}, {"x", axis(chart.x)},         {"y", axis(chart.y)},         {"series", series},
          {"markers", markers},   {"equal", chart.equal_scale}, {"diagonal", chart.diagonal}, {"note", chart.note}};
}

json json_of(const PageTable& table) {
  return {{"title", table.title}, {"columns", table.columns}, {"rows", table.rows}, {"note", table.note}};
}

json json_of(const PageSection& section) {
  json charts = json::array();
  for (const PageChart& chart : section.charts) charts.push_back(json_of(chart));
  json tables = json::array();
  for (const PageTable& table : section.tables) tables.push_back(json_of(table));
  return {{"title", section.title}, {"id", section.id}, {"words", section.words}, {"charts", charts}, {"tables", tables}};
}

/// Collects the binary parts of a page, each in an element of its own.
class PageBlobs {
 public:
  /// @return the id of the element
  std::string add(std::string_view bytes) {
    std::string id = "blob-" + std::to_string(count_++);
    text_ += "<script type=\"text/plain\" id=\"" + id + "\">" + base64_text(bytes) + "</script>\n";
    return id;
  }
  template <class Value>
  std::string add_values(const std::vector<Value>& values) {
    std::string bytes(values.size() * sizeof(Value), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return add(bytes);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

json json_of(const PageBody& body, PageBlobs& blobs) {
  json centres = json::array();
  for (const auto& centre : body.centres_m) centres.push_back({rounded(centre[0]), rounded(centre[1]), rounded(centre[2])});
  json pressures = json::array();
  for (const std::vector<double>& one : body.pressures_Pa) pressures.push_back(rounded(one));
  const auto bytes = [&](const std::vector<std::uint8_t>& values) {
    return values.empty() ? json(nullptr) : json(blobs.add_values(values));
  };
  return {{"name", body.name},
          {"corners", body.corners},
          {"faces", blobs.add_values(body.faces)},
          {"positions", blobs.add_values(body.positions)},
          {"times", rounded(body.times)},
          {"origin", body.origin_m},
          {"scale", body.scale_m},
          {"materials", bytes(body.materials)},
          {"chambers", bytes(body.chambers)},
          {"pressures", pressures},
          {"centres", centres},
          {"travelled", rounded(body.travelled_m)}};
}

json json_of(const PageScene& scene, PageBlobs& blobs) {
  json bodies = json::array();
  for (const PageBody& body : scene.bodies) bodies.push_back(json_of(body, blobs));
  return {{"title", scene.title},
          {"source", scene.source},
          {"clock", scene.clock},
          {"unit", scene.unit},
          {"ground", scene.ground_m ? json(*scene.ground_m) : json(nullptr)},
          {"bodies", bodies},
          {"note", scene.note},
          {"animation", scene.animation}};
}

/// JSON that can stand in a script element: without "<", so that nothing in it can end the element, and in ASCII.
std::string script_json(const json& data) {
  const std::string text = data.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&') {
      safe += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : "\\u0026";
    } else {
      safe += c;
    }
  }
  return safe;
}

const char* badge_of(Tone tone) {
  switch (tone) {
    case Tone::note:
      return "to know";
    case Tone::good:
      return "holds";
    case Tone::caution:
      return "with care";
    case Tone::bad:
      return "does not hold";
    case Tone::missing:
      return "not computed";
  }
  return "";
}

/// What a newcomer has to know.
std::vector<std::pair<std::string, std::string>> explained_words() {
  return {
      {"finite elements",
       "the model of the hollow silicone body that everything else is measured against. It is no measurement."},
      {"surrogate", "the body as voxels and beams, fitted to finite elements: fast enough for a search."},
      {"voxels", "without \"surrogate\", solid cubes that swell, and no silicone."},
      {"chamber, plenum", "a closed hollow in the silicone; chambers joined by holes, which share one pressure."},
      {"limit pressure", "where the pressure stops rising while the volume grows: the body balloons or buckles."},
      {"path parameter",
       "how far an inflation has come along its path of pressures or volumes: at 1, 2, ... it has those that its study names."},
      {"range of the fit", "the pressures, lengths and walls that the surrogate was fitted to."},
      {"body length", "the longest side of the body at rest; 2 body lengths is twice as far as the body is long."},
      {"displacement that goes the wrong way", "one that has another sign in the surrogate; only those of at least " +
                                                   io::millimetres(meshes::smallest_signed_m) +
                                                   " have one, so that fewer are counted than are compared."},
      {"rank correlation",
       "1 if both models put robots in the same order, 0 if one order tells nothing of the other, -1 if they are opposite. "
       "Spearman "
       "and Kendall count it in two ways."},
      {"95 % from, to", "the interval that holds the true value in 19 of 20 such samples of robots."},
      {"champion, age", "the best robot, and for how many generations its line has lived since its eldest ancestor was new."},
      {"phenotype", "the cells of a body as digits, along x first, then y, then z: 0 is empty, 1 and 2 are materials."},
      {"period, stroke", "once up and down of the pressure of the drive."},
      {"fitness", "what a search makes as large as it can: how far a robot goes, unless its study says otherwise."},
  };
}

/// A path as part of an address: whatever is no letter, digit or mark of paths is written in hexadecimal digits.
std::string address_of(std::string_view path) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string address;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (plain.find(c) != std::string_view::npos) {
      address += c;
    } else {
      address += '%';
      address += digits[byte >> 4U];
      address += digits[byte & 15U];
    }
  }
  return address;
}

/// The address of a file of the report, from the page. @param folder of the report, from that of the page
std::string address_in(const std::string& folder, std::string_view file) {
  return address_of((folder.empty() ? "." : folder) + "/" + std::string(file));
}

/// The files of a source, each a link to it.
std::string linked_html(std::string_view source, const std::string& folder) {
  constexpr std::string_view separator = ", ";
  std::string text;
  while (!source.empty()) {
    const std::size_t end = std::min(source.find(separator), source.size());
    const std::string_view file = source.substr(0, end);
    text += (text.empty() ? "" : ", ") + ("<a href=\"" + address_in(folder, file) + "\">" + html_text(file) + "</a>");
    source.remove_prefix(std::min(end + separator.size(), source.size()));
  }
  return text;
}

std::string finding_html(const Finding& finding, const std::string& folder) {
  std::string text = "<li><span class=\"badge " + std::string(to_string(finding.tone)) + "\">" + badge_of(finding.tone) +
                     "</span><div><p>" + html_text(finding.text) + "</p>";
  if (!finding.source.empty()) {
    text += "<p class=\"source\">" +
            (finding.tone == Tone::missing ? "computed by " + html_text(finding.source)
                                           : "from " + linked_html(finding.source, folder)) +
            "</p>";
  }
  return text + "</div></li>\n";
}

std::string headline_html(const Verdict& verdict) {
  const std::string tone = to_string(verdict.tone);
  if (verdict.came_out.empty()) return "<p class=\"headline " + tone + "\">" + html_text(verdict.headline) + "</p>\n";
  std::string text = "<div class=\"headline " + tone + "\"><p>What came out:</p><ul>\n";
  for (const std::string& line : verdict.came_out) text += "<li>" + html_text(line) + "</li>\n";
  return text + "</ul></div>\n";
}

/// What the loop said first. Warnings stay in sight.
std::string forecast_html(const std::vector<std::string>& forecast) {
  std::string warnings;
  std::string others;
  for (const std::string& line : forecast)
    (line.starts_with("warning: ") ? warnings : others) += "<li>" + html_text(line) + "</li>\n";
  std::string text;
  if (!warnings.empty()) text += "<ul class=\"words\">\n" + warnings + "</ul>\n";
  if (!others.empty())
    text +=
        "<details><summary>What was to be expected of this robot</summary><ul class=\"words\">\n" + others + "</ul></details>\n";
  return text;
}

std::string verdict_html(const Verdict& verdict, const std::string& folder) {
  std::string found;
  std::string missing;
  std::size_t missing_count = 0;
  for (const Finding& finding : verdict.findings) {
    (finding.tone == Tone::missing ? missing : found) += finding_html(finding, folder);
    if (finding.tone == Tone::missing) ++missing_count;
  }
  std::string text = "<h2 id=\"verdict-title\">Verdict</h2>\n" + headline_html(verdict) + forecast_html(verdict.forecast);
  // A long list of what is not there would hide what is.
  constexpr std::size_t most_open = 2;
  const bool is_open = missing_count <= most_open || found.empty();
  const std::string findings = "<ul class=\"findings\">\n" + found + (is_open ? missing : "") + "</ul>\n";
  // A loop has told the most of it already.
  text += verdict.came_out.empty()
              ? findings
              : "<details><summary>All findings, with the files that they come from</summary>\n" + findings + "</details>\n";
  if (!is_open)
    text += "<details><summary>" + io::counted(missing_count, "thing") + (missing_count == 1 ? " was" : " were") +
            " not computed</summary><ul class=\"findings\">\n" + missing + "</ul></details>\n";
  text += "<details><summary>How this is judged</summary><ul class=\"words\">\n";
  for (const std::string& words : judging_words()) text += "<li>" + html_text(words) + "</li>\n";
  text += "</ul></details>\n<details><summary>Words on this page</summary><dl>\n";
  for (const auto& [word, meaning] : explained_words())
    text += "<dt>" + html_text(word) + "</dt><dd>" + html_text(meaning) + "</dd>\n";
  return text + "</dl></details>";
}

/// The inputs as a table without code, so that what a page is about can be read without JavaScript, too.
std::string inputs_html(const PageTable& inputs) {
  if (inputs.rows.empty()) return {};
  std::string text = "<section id=\"inputs\" aria-labelledby=\"inputs-title\">\n<h2 id=\"inputs-title\">" +
                     html_text(inputs.title) + "</h2>\n<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"" +
                     html_text(inputs.title) + "\"><table><tbody>\n";
  for (const std::vector<std::string>& row : inputs.rows)
    text += "<tr><th scope=\"row\">" + html_text(row.front()) + "</th><td>" + html_text(row.back()) + "</td></tr>\n";
  return text + "</tbody></table></div>\n<p class=\"note\">" + html_text(inputs.note) + "</p>\n</section>";
}

/// Replaces the marks of a template, each once, from left to right: what is put in is not searched.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string made;
  while (!text.empty()) {
    std::size_t first = std::string_view::npos;
    const std::pair<std::string_view, std::string>* next = nullptr;
    for (const auto& part : parts) {
      const std::size_t at = text.find(part.first);
      if (at < first) {
        first = at;
        next = &part;
      }
    }
    if (next == nullptr) break;
    made.append(text.substr(0, first)).append(next->second);
    text.remove_prefix(first + next->first.size());
  }
  return made.append(text);
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string safe;
  for (const char c : io::printable(text)) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string base64_text(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < 3; ++n) group = group << 8U | (n < count ? static_cast<unsigned char>(bytes[at + n]) : 0U);
    for (std::size_t n = 0; n < 4; ++n) text += n <= count ? digits[group >> (18U - 6U * n) & 63U] : '=';
  }
  return text;
}

std::string page_text(const ReportPage& page, const std::optional<std::string>& three) {
  PageBlobs blobs;
  json scenes = json::array();
  if (three)
    for (const PageScene& scene : page.scenes) scenes.push_back(json_of(scene, blobs));
  json sections = json::array();
  for (const PageSection& section : page.sections) sections.push_back(json_of(section));
  json pictures = json::array();
  for (const PagePicture& picture : page.pictures) {
    pictures.push_back({{"caption", picture.caption},
                        {"file", picture.file},
                        {"link", address_in(page.folder, picture.file)},
                        {"blob", blobs.add(picture.png)}});
  }
  const json data{{"scenes", scenes}, {"sections", sections}, {"pictures", pictures}, {"notes", page.notes}};
  std::string script;
  for (const char* name : {"chart.js", "scene.js", "page.js"}) script.append(page_source(name));
  const std::string title = html_text(page.title);
  return filled(page_source("page.html"),
                {{"<!--menger:title-->", title},
                 {"<!--menger:made-->", html_text(page.made)},
                 {"/*menger:style*/", std::string(page_source("page.css"))},
                 {"<!--menger:verdict-->", verdict_html(page.verdict, page.folder)},
                 {"<!--menger:inputs-->", inputs_html(page.inputs)},
                 {"<!--menger:data-->",
                  blobs.text() + "<script type=\"application/json\" id=\"report-data\">" + script_json(data) + "</script>"},
                 {"/*menger:three*/", three.value_or("")},
                 {"/*menger:script*/", script}});
}

ThreeCode read_three(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    if (!io::is_file(file)) continue;
    std::string code = io::read_whole(file);
    // Code that could end its element would be no three.js.
    if (code.find("</script") != std::string::npos) return {std::nullopt, file.string() + ": is not the code of three.js"};
    return {std::move(code), {}};
  }
  return {std::nullopt,
          "no 3-D: three.js is missing (" + (files.empty() ? "" : files.front().string()) + "): install the package libjs-three"};
}

ThreeCode read_three() {
  return read_three(
      {MENGER_THREE_JS, "/usr/share/javascript/three/build/three.min.js", "/usr/share/nodejs/three/build/three.min.js"});
}

}  // namespace menger::evolution
