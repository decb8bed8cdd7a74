#include "materials/laws/law_file.h"

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "materials/laws/study_law.h"

namespace menger::materials {

HyperelasticLaw read_law(const io::TomlTable& table) {
  HyperelasticLaw law;
  io::StudyReader reader(table);
  describe(reader, law);
  return law;
}

std::string law_text(const HyperelasticLaw& law) { return io::described_text(law); }

std::string law_line(const HyperelasticLaw& law) {
  std::string text = law_text(law);
  text.pop_back();  // the end of the last line
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, ", ");
  return text;
}

}  // namespace menger::materials
