#include "evolution/page/page_text.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "voxel/picture/picture_parts.h"

namespace menger::evolution {
namespace {

const std::string hostile = "</script><script>window.harmed = 1</script><img src=x onerror=\"window.harmed = 2\">&'\x1b";

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// A scene of one triangle, all of whose texts are one.
PageScene triangle(const std::string& text) {
  return {.title = text,
          .source = text,
          .clock = text,
          .unit = text,
          .bodies = {{.name = text,
                      .faces = {{0, 1, 2, 2}},
                      .corners = 3,
                      .times = {0.0},
                      .positions = std::vector<std::int16_t>(9),
                      .centres_m = {{0.0, 0.0, 0.0}}}},
          .note = text};
}

ReportPage hostile_page() {
  ReportPage page{
      .title = hostile, .made = hostile, .verdict = {.headline = hostile, .findings = {{Tone::bad, hostile, hostile}}}};
  page.sections = {{.title = hostile,
                    .id = "walks",
                    .words = {hostile},
                    .charts = {{.title = hostile,
                                .x = {hostile},
                                .y = {hostile},
                                .series = {{.name = hostile, .x = {1.0}, .y = {2.0}, .labels = {hostile}}},
                                .note = hostile}},
                    .tables = {{.title = hostile, .columns = {hostile}, .rows = {{hostile}}, .note = hostile}}}};
  page.pictures = {{.caption = hostile, .png = "\x89PNG"}};
  page.notes = {hostile};
  page.scenes = {triangle(hostile)};
  return page;
}

TEST(PageText, IsBase64AsOthersWriteIt) {
  EXPECT_EQ(base64_text(""), "");
  EXPECT_EQ(base64_text("f"), "Zg==");
  EXPECT_EQ(base64_text("fo"), "Zm8=");
  EXPECT_EQ(base64_text("foo"), "Zm9v");
  EXPECT_EQ(base64_text("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_text(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(PageText, EscapesMarkupAndControlCharacters) {
  EXPECT_EQ(html_text("<b>\"a\" & 'b'</b>"), "&lt;b&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/b&gt;");
  EXPECT_EQ(html_text("\x1b[2J"), "\\u001B[2J");
}

TEST(PageText, MakesNoMarkupOfTexts) {
  const std::string three = "var THREE;";
  const std::string harmless = page_text({.title = "t",
                                          .made = "m",
                                          .verdict = {.headline = "h", .findings = {{Tone::bad, "f", "s"}}},
                                          .scenes = {triangle("a scene")},
                                          .pictures = {{.caption = "c", .png = "\x89PNG"}}},
                                         three);
  ASSERT_NE(harmless.find("a scene"), std::string::npos) << "scenes are on the page";
  const std::string text = page_text(hostile_page(), three);
  EXPECT_EQ(text.find("<script>window.harmed"), std::string::npos);
  EXPECT_EQ(text.find("<img"), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  // Hostile texts bring no element that harmless ones do not.
  EXPECT_EQ(count_of(text, "<script"), count_of(harmless, "<script"));
  EXPECT_EQ(count_of(text, "</script"), count_of(harmless, "</script"));
}

TEST(PageText, LinksItsSources) {
  ReportPage page{.title = "t", .made = "m", .folder = "../results", .verdict = {.headline = "h"}};
  page.verdict.findings = {{Tone::good, "f", "a b/result.toml, \"c\".csv"}, {Tone::missing, "g", "menger inflate"}};
  const std::string text = page_text(page, std::nullopt);
  EXPECT_NE(text.find("from <a href=\"../results/a%20b/result.toml\">a b/result.toml</a>, "
                      "<a href=\"../results/%22c%22.csv\">&quot;c&quot;.csv</a>"),
            std::string::npos);
  EXPECT_NE(text.find("computed by menger inflate<"), std::string::npos) << "no file";
}

TEST(PageText, SpreadsNoDataIntoArguments) {
  // A browser refuses a call with some hundred thousand arguments, which a long table would bring.
  for (const char* name : {"chart.js", "scene.js", "page.js"})
    for (const char* call : {"Math.min(...", "Math.max(...", "Math.min(0, ...", "push(..."})
      EXPECT_EQ(page_source(name).find(call), std::string_view::npos) << name << " has " << call;
}

TEST(PageText, HasTheColoursOfMaterialsThatPicturesHave) {
  for (std::size_t n = 0; n < 2; ++n) {
    std::string colour = "--m" + std::to_string(n + 1) + ": #";
    for (const unsigned char part : voxel::material_colours.at(n))
      for (const unsigned digit : {part / 16U, part % 16U}) colour += "0123456789abcdef"[digit];
    EXPECT_NE(page_source("page.css").find(colour), std::string_view::npos) << colour;
  }
}

TEST(PageText, SearchesNoMarkInWhatIsPutIn) {
  const ReportPage page{.title = "/*menger:script*/<!--menger:data-->", .made = "/*menger:style*/", .verdict = {.headline = "h"}};
  const std::string text = page_text(page, "/*menger:script*/");
  EXPECT_EQ(count_of(text, "function drawPage()"), 1U);
  EXPECT_EQ(count_of(text, "id=\"report-data\""), 1U);
  EXPECT_EQ(count_of(text, "--paper: #ffffff"), 1U);
}

TEST(PageText, LoadsNothingFromElsewhere) {
  const std::string text = page_text(hostile_page(), std::nullopt);
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  for (const char* name : {"page.html", "page.css", "chart.js", "scene.js", "page.js"}) {
    const std::string source(page_source(name));
    ASSERT_FALSE(source.empty()) << name;
    for (const char* from : {"src=\"http", "href=\"http", "url(", "import(", "fetch(", "innerHTML", "document.write"})
      EXPECT_EQ(source.find(from), std::string::npos) << name << " has " << from;
  }
}

TEST(PageText, HasMotionsOnlyWithTheCodeThatMovesThem) {
  ReportPage page{.title = "t", .made = "m", .verdict = {.headline = "h"}};
  page.scenes = {triangle("a walk")};
  EXPECT_EQ(page_text(page, std::nullopt).find("a walk"), std::string::npos);
  EXPECT_NE(page_text(page, "var THREE;").find("a walk"), std::string::npos);
}

TEST(PageText, FoldsALongListOfWhatWasNotComputed) {
  const Finding missing{Tone::missing, "M was not computed.", "menger m"};
  ReportPage page{
      .title = "t", .made = "m", .verdict = {.headline = "h", .findings = {{Tone::good, "f", "s"}, missing, missing}}};
  const std::string folded = "things were not computed</summary>";
  EXPECT_EQ(page_text(page, std::nullopt).find(folded), std::string::npos);
  page.verdict.findings.push_back(missing);
  EXPECT_NE(page_text(page, std::nullopt).find("3 " + folded), std::string::npos);
  page.verdict.findings.erase(page.verdict.findings.begin());
  EXPECT_EQ(page_text(page, std::nullopt).find(folded), std::string::npos) << "nothing else would be left";
}

TEST(PageText, SaysWhatIsMissingFor3d) {
  const tests::TestFolder folder;
  const ThreeCode none = read_three({folder / "three.min.js"});
  EXPECT_FALSE(none.code);
  EXPECT_NE(none.missing.find("install the package libjs-three"), std::string::npos);
  io::write_whole(folder / "three.min.js", "var THREE;");
  EXPECT_EQ(read_three({folder / "missing.js", folder / "three.min.js"}).code, "var THREE;");
  io::write_whole(folder / "three.min.js", "</script>");
  EXPECT_FALSE(read_three({folder / "three.min.js"}).code);
}

}  // namespace
}  // namespace menger::evolution
