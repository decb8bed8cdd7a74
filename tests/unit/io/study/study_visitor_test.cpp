#include "io/study/study_visitor.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/study/study_keys.h"
#include "io/study/study_reader.h"
#include "io/study/study_schema.h"
#include "io/study/study_template.h"
#include "io/study/study_text.h"
#include "tests/support/input_error_message.h"
#include "tests/support/random_study.h"

namespace menger::io {
namespace {

enum class Method { direct, iterative };
enum class Drive { pressure, volume };

/// A study with a key of every kind.
struct Garden {
  struct Bed {
    std::string name = "bed";
    double length_m = 1.0;
    bool operator==(const Bed&) const = default;
  };
  struct Pump {
    double flow_m3 = 0.5;
    bool operator==(const Pump&) const = default;
  };

  double size_m = 0.0;
  int cats = 2;
  std::optional<int> depth = 3;
  bool is_sunny = true;
  double frequency_Hz = 0.25;
  Method method = Method::direct;
  double tolerance = 1e-3;
  Drive drive = Drive::pressure;
  double amount = 100.0;
  std::optional<double> height_m;
  std::array<double, 3> centre_m{};
  std::vector<int> levels{1, 2};
  std::vector<std::string> plants;
  std::vector<Method> methods{Method::iterative};
  std::filesystem::path map = "map.csv";
  std::vector<Bed> beds;
  std::optional<Pump> pump;

  bool operator==(const Garden&) const = default;
};

const Words<Method> method_words{{"direct", Method::direct}, {"iterative", Method::iterative}};

void describe(StudyVisitor& visitor, Garden& garden) {
  visitor.number({"size_m", "Length of a side.", "4", "/fence.extent_m"}, garden.size_m, positive());
  visitor.table({"soil", "What lies below."}, [&] {
    visitor.integer_or_word({"depth", "Layers."}, garden.depth, "off", at_least(1));
    visitor.boolean({"is_sunny", "Whether the sun shines."}, garden.is_sunny);
    const Key frequency{.name = "frequency_Hz", .help = "How often it rains.", .earlier = "period_s", .was_reciprocal = true};
    visitor.number(frequency, garden.frequency_Hz, positive());
  });
  visitor.integer({"cats", "How many."}, garden.cats, within(0, 9));
  visitor.word({"method", "How weeds are found."}, garden.method, method_words);
  visitor.only_if(garden.method == Method::iterative, "method = \"iterative\"", [&] {
    visitor.number({"tolerance", "Weeds that stay."}, garden.tolerance, positive());
  });
  const auto choose = [&](Drive drive) { return [&garden, drive] { garden.drive = drive; }; };
  visitor.one_of({{"pressure_Pa", garden.drive == Drive::pressure, choose(Drive::pressure),
                   [&] {
                     visitor.number({"pressure_Pa", "Of the water."}, garden.amount);
                   }},
                  {"volume_m3", garden.drive == Drive::volume, choose(Drive::volume), [&] {
                     visitor.number({"volume_m3", "Of the water."}, garden.amount);
                   }}});
  visitor.optional_number({"height_m", "Of the fence.", "1.5"}, garden.height_m, non_negative());
  visitor.check(!garden.height_m || *garden.height_m < garden.size_m, "height_m", "must be less than size_m");
  visitor.numbers({"centre_m", "Where the tree stands."}, garden.centre_m);
  visitor.integers({"levels", "Terraces."}, garden.levels, within(1, 9), {.fewest = 1});
  visitor.texts({"plants", "What grows."}, garden.plants);
  visitor.words({"methods", "Others to try."}, garden.methods, method_words);
  visitor.path({"map", "A table of places."}, garden.map);
  visitor.tables({"beds", "Where plants grow."}, garden.beds, [&](Garden::Bed& bed) {
    visitor.text({"name", "Of the bed.", "\"roses\""}, bed.name);
    visitor.number({"length_m", "Along the path."}, bed.length_m, positive());
  });
  visitor.optional_table({"pump", "Brings water."}, garden.pump, [&](Garden::Pump& pump) {
    visitor.number({"flow_m3", "In an hour."}, pump.flow_m3, positive());
  });
}

Garden read(const std::string& text) {
  Garden garden;
  read_described(parse_toml(text, "garden.toml"), garden);
  return garden;
}

std::string message(const std::string& text) {
  return tests::message_of([&] { (void)read(text); });
}

TEST(StudyReader, KeepsDefaultsAndReadsTheRest) {
  const Garden garden = read(
      "size_m = 3\nmethod = \"iterative\"\ntolerance = 0.1\nvolume_m3 = 7\n[soil]\ndepth = \"off\"\n"
      "[[beds]]\nname = \"a\"\n[[beds]]\nname = \"b\"\nlength_m = 2\n[pump]\n");
  Garden expected;
  expected.size_m = 3.0;
  expected.method = Method::iterative;
  expected.tolerance = 0.1;
  expected.drive = Drive::volume;
  expected.amount = 7.0;
  expected.depth.reset();
  expected.beds = {{"a", 1.0}, {"b", 2.0}};
  expected.pump.emplace();
  expected.map = "map.csv";
  EXPECT_EQ(garden, expected);
}

TEST(StudyReader, NamesFileKeyAndValueOfBadInput) {
  const std::vector<std::array<std::string, 2>> cases{
      {"", "garden.toml:1: size_m is missing: a number is needed"},
      {"size_m = 0", "garden.toml:1: size_m = 0: must be > 0"},
      {"size_m = 1\ncats = 10", "garden.toml:2: cats = 10: must be in [0, 9]"},
      {"size_m = 1\ncats = 1.5", "must be an integer"},
      {"size_m = 1\ndog = 1", "garden.toml:2: dog: unknown key"},
      {"size_m = 1\ncat = 1", "did you mean cats?"},
      {"[fence]\nextent_m = 1", "garden.toml:2: fence.extent_m = 1: is called size_m now"},
      {"size_m = 1\n[soil]\nperiod_s = 2", "soil.period_s = 2: is called soil.frequency_Hz now, the reciprocal of this number"},
      {"size_m = 1\nmethod = \"guess\"", "must be \"direct\" | \"iterative\""},
      {"size_m = 1\ntolerance = 1", "tolerance = 1: belongs to method = \"iterative\""},
      {"size_m = 1\npressure_Pa = 1\nvolume_m3 = 1", "volume_m3 = 1: pressure_Pa is also given: keep one of them"},
      {"size_m = 1\nheight_m = 2", "height_m = 2: must be less than size_m"},
      {"size_m = 1\ncentre_m = [1, 2]", "must be three numbers, not 2"},
      {"size_m = 1\nlevels = []", "needs at least one of its integers"},
      {"size_m = 1\nlevels = [1.5]", "levels[1] = 1.5: must be an integer"},
      {"size_m = 1\nmethods = [\"direct\", \"no\"]", "methods[2] = \"no\": must be \"direct\" | \"iterative\""},
      {"size_m = 1\n[soil]\ndepth = 0", "soil.depth = 0: must be >= 1"},
      {"size_m = 1\n[soil]\ndepth = \"no\"", "soil.depth = \"no\": must be an integer >= 1 or \"off\""},
      {"size_m = 1\n[soil]\nsun = 1", "soil.sun: unknown key"},
      {"size_m = 1\n[[beds]]\nlength_m = 1", "beds[1].name is missing: a text in quotes is needed"},
  };
  for (const auto& [text, expected] : cases) EXPECT_NE(message(text).find(expected), std::string::npos) << message(text);
}

TEST(StudyReader, RefusesNumbersThatNoModelBears) {
  const std::vector<std::array<std::string, 2>> cases{
      {"size_m = 1e300", "garden.toml:1: size_m = 1e+300: must be at most 1e+06 m in magnitude: no model bears more"},
      {"size_m = 1e-200", "size_m = 1e-200: must be at least 1e-09 m: no model bears less"},
      {"size_m = 1\nheight_m = 1e-200", "height_m = 1e-200: must be at least 1e-09 m or 0: no model bears less"},
      {"size_m = 1\n[soil]\nfrequency_Hz = 1e300", "soil.frequency_Hz = 1e+300: must be at most 1e+09 Hz in magnitude"},
      {"size_m = 1\nmethod = \"iterative\"\ntolerance = 1e300", "tolerance = 1e+300: must be at most 1e+18 in magnitude"},
      {"size_m = 1\npressure_Pa = -1e300", "pressure_Pa = -1e+300: must be at most 1e+30 Pa in magnitude"},
      {"size_m = 1\ncentre_m = [0, 1, -1e7]", "centre_m[3] = -1e+07: must be at most 1e+06 m in magnitude"},
  };
  for (const auto& [text, expected] : cases) EXPECT_NE(message(text).find(expected), std::string::npos) << message(text);
  EXPECT_EQ(read("size_m = 1e6\nheight_m = 0\ncentre_m = [1e-300, -1e-300, 0]").centre_m[0], 1e-300)
      << "of numbers that may be negative, small ones are as good as 0";
}

TEST(StudyReader, KeepsEveryDigitOfIntegers) {
  struct Seeds {
    std::vector<std::int64_t> seeds;
    std::vector<std::uint8_t> small;
  };
  const auto read_seeds = [](const std::string& text) {
    Seeds seeds;
    const TomlTable table = parse_toml(text, "seeds.toml");
    StudyReader reader(table);
    StudyVisitor& visitor = reader;
    visitor.integers({"seeds", "Of random numbers."}, seeds.seeds, {}, {.fewest = 1});
    visitor.integers({"small", "Of few bits."}, seeds.small, at_least(1));
    return seeds;
  };
  const std::vector<std::int64_t> large{9007199254740993, -9007199254740993, 9223372036854775807,
                                        std::int64_t{-9223372036854775807} - 1};
  std::string list;
  for (const std::int64_t seed : large) list += (list.empty() ? "" : ", ") + std::to_string(seed);
  EXPECT_EQ(read_seeds("seeds = [" + list + "]").seeds, large);
  const auto refusal = [&](const std::string& text) { return tests::message_of([&] { (void)read_seeds(text); }); };
  EXPECT_EQ(refusal("seeds = [1, 2.0]"), "seeds.toml:1: seeds[2] = 2.0: must be an integer");
  EXPECT_EQ(refusal("seeds = []"), "seeds.toml:1: seeds = []: needs at least one of its integers");
  EXPECT_EQ(refusal("seeds = [1]\nsmall = [255, 256]"), "seeds.toml:2: small[2] = 256: must be at most 255");
  EXPECT_EQ(refusal("seeds = [1]\nsmall = [0]"), "seeds.toml:2: small[1] = 0: must be >= 1");
}

// A description is wrong whose words miss a value of the enumeration.
TEST(Words, WithoutTheWordOfAValueAreReported) {
  EXPECT_EQ(value_of(method_words, "iterative"), Method::iterative);
  const auto message_for = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message_for([] { (void)value_of(method_words, "guess"); }),
            "\"guess\" is none of the words of this key, \"direct\" | \"iterative\"");
  const Words<Method> direct_only{{"direct", Method::direct}};
  StudyTextWriter writer;
  StudyVisitor& visitor = writer;
  Method method = Method::iterative;
  EXPECT_EQ(message_for([&] {
              visitor.word({"method", "How."}, method, direct_only);
            }),
            "\"\" is none of the words of this key, \"direct\"");
}

enum class Fruit { apple, pear };
std::string_view to_string(Fruit fruit) { return fruit == Fruit::apple ? "apple" : "pear"; }

TEST(Words, OfAnEnumerationAreThoseOfToString) {
  EXPECT_EQ(words_of(Fruit::pear, Fruit::apple), (Words<Fruit>{{"pear", Fruit::pear}, {"apple", Fruit::apple}}));
}

TEST(StudyReader, ReadsEarlierNamesOfWhatProgramsWrote) {
  Garden garden;
  read_described(parse_toml("[fence]\nextent_m = 3\n[soil]\nperiod_s = 2\n", "archive"), garden, StudyReader::EarlierNames::read);
  EXPECT_EQ(garden.size_m, 3.0);
  EXPECT_EQ(garden.frequency_Hz, 0.5);
}

// A garden of an earlier version, with lists of its keys and with parts that its present form has elsewhere.
struct OldGarden {
  std::string design;
  double depth_m = 1.0;
  double leak = 0.1;
  double height_m = 0.5;
  Drive drive = Drive::pressure;
  double rate = 1.0;
  std::vector<Garden::Bed> beds;
  std::vector<std::string> varied;
};

void describe(StudyVisitor& visitor, OldGarden& garden) {
  visitor.table({.name = "design", .help = "Its plan.", .earlier_text = "design.file"}, [&] {
    visitor.text({"file", "Of the plan."}, garden.design);
  });
  visitor.table({.name = "pond", .help = "Water.", .earlier = "/pool"}, [&] {
    visitor.number({.name = "depth_m", .help = "Below the ground.", .earlier = "deepness_m"}, garden.depth_m);
    visitor.only_if(garden.depth_m > 2.0, "depth_m > 2", [&] {
      visitor.number({.name = "leak_m_per_s", .help = "Of the pond.", .earlier = "/leak"}, garden.leak);
      visitor.table({"weir", "Holds the water."}, [&] { visitor.number({"height_m", "Of the weir."}, garden.height_m); });
    });
  });
  const auto choose = [&](Drive drive) { return [&garden, drive] { garden.drive = drive; }; };
  visitor.one_of({{"pressure_Pa", garden.drive == Drive::pressure, choose(Drive::pressure),
                   [&] {
                     visitor.number({"pressure_Pa", "Of the water."}, garden.rate);
                   }},
                  {"flow_m3", garden.drive == Drive::volume, choose(Drive::volume), [&] {
                     visitor.number({.name = "flow_m3", .help = "In an hour.", .earlier = "hour_per_m3", .was_reciprocal = true},
                                    garden.rate);
                   }}});
  visitor.tables({"beds", "Where plants grow."}, garden.beds, [&](Garden::Bed& bed) {
    visitor.number({.name = "length_m", .help = "Along the path.", .earlier = "long_m"}, bed.length_m);
  });
  visitor.key_names({"varied", "Keys that are varied."}, garden.varied);
}

std::string old_message(const std::string& text) {
  return tests::message_of([&] {
    OldGarden garden;
    read_described(parse_toml(text, "garden.toml"), garden);
  });
}

TEST(EarlierNames, OfAFileAreAllToldAtOnce) {
  EXPECT_EQ(old_message("varied = [\"pond.depth_m\", \"pool.deepness_m\", \"leak\", \"sun\", \"hour_per_m3\"]\n"
                        "design = \"plan.toml\"\nleak = 3\nhour_per_m3 = 2\n[pool]\ndeepness_m = 1\n"
                        "[[beds]]\nlength_m = 1\n[[beds]]\nlong_m = 2\n"),
            "garden.toml:2: design = \"plan.toml\": is called design.file now\n"
            "garden.toml:5: pool = {...}: is called pond now\n"
            "garden.toml:6: pool.deepness_m = 1: is called pond.depth_m now\n"
            "garden.toml:3: leak = 3: is called pond.leak_m_per_s now\n"
            "garden.toml:4: hour_per_m3 = 2: is called flow_m3 now, the reciprocal of this number\n"
            "garden.toml:10: beds[2].long_m = 2: is called beds[2].length_m now\n"
            "garden.toml:1: varied[2] = \"pool.deepness_m\": is called pond.depth_m now\n"
            "garden.toml:1: varied[3] = \"leak\": is called pond.leak_m_per_s now\n"
            "garden.toml:1: varied[5] = \"hour_per_m3\": is called flow_m3 now, the reciprocal of this number");
}

TEST(EarlierNames, InAListOfKeysAreToldAlone) {
  EXPECT_EQ(old_message("varied = [\"leak\"]"), "garden.toml:1: varied[1] = \"leak\": is called pond.leak_m_per_s now");
  EXPECT_EQ(old_message("varied = [\"pool.depth_m\"]"),
            "garden.toml:1: varied[1] = \"pool.depth_m\": is called pond.depth_m now");
  EXPECT_EQ(old_message("varied = [\"pond.depth_m\", \"flow_m3\"]"), "no error");
}

// To look for earlier names asks for tables. The reader must still refuse those that it does not ask for.
TEST(EarlierNames, DoNotHideUnknownKeys) {
  EXPECT_EQ(old_message("pond.weir.height_m = 1"), "garden.toml:1: pond.weir = {...}: belongs to depth_m > 2");
  EXPECT_EQ(old_message("[pond]\nfish = 3\n[[beds]]\nlengths_m = 1\n[design]\nfile = \"plan.toml\"\nname = \"plan\"\n"),
            "garden.toml:4: beds[1].lengths_m: unknown key, did you mean length_m?\n"
            "garden.toml:7: design.name: unknown key\n"
            "garden.toml:2: pond.fish: unknown key");
}

TEST(StudyText, IsReadBackToTheSameStudy) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Garden garden;
    tests::RandomStudy random(seed);
    describe(random, garden);
    if (garden.height_m && *garden.height_m >= garden.size_m) continue;
    const std::string text = described_text(garden);
    EXPECT_EQ(described_text(read(text)), text);
    EXPECT_EQ(read(text), garden) << text;
    ++compared;
  }
  EXPECT_GT(compared, 100U);
}

TEST(StudyText, PutsTablesAfterValues) {
  Garden garden;
  garden.size_m = 2.0;
  EXPECT_EQ(described_text(garden),
            "size_m = 2\ncats = 2\nmethod = \"direct\"\npressure_Pa = 100\ncentre_m = [0, 0, 0]\nlevels = [1, 2]\nplants = []\n"
            "methods = [\"iterative\"]\nmap = \"map.csv\"\n[soil]\ndepth = 3\nis_sunny = true\nfrequency_Hz = 0.25\n");
}

// The study that a template was made of has, at the end, what the template says.
TEST(StudyTemplate, IsReadToTheDefaultsAndToEachAlternative) {
  Garden garden;
  StudyTemplateWriter usual;
  describe(usual, garden);
  EXPECT_EQ(garden.size_m, 4.0) << "an example where a value must be given";
  EXPECT_EQ(read(usual.text()), garden) << usual.text();
  EXPECT_EQ(described_text(garden), described_text(read("size_m = 4")));

  // a word, a key beside another, a key that may be left out, an array and a table that are not there
  ASSERT_EQ(usual.alternative_count(), 5U);
  const std::array<std::string, 5> names{"method = \"iterative\"", "volume_m3", "height_m", "beds", "pump"};
  for (std::size_t n = 0; n < usual.alternative_count(); ++n) {
    Garden other;
    StudyTemplateWriter writer(n);
    describe(writer, other);
    EXPECT_EQ(writer.enabled_name(), names.at(n));
    EXPECT_NE(described_text(other), described_text(garden)) << names.at(n);
    EXPECT_EQ(read(writer.text()), other) << writer.text();
  }
}

TEST(StudyTemplate, ExplainsEveryKey) {
  Garden garden;
  StudyTemplateWriter writer;
  describe(writer, garden);
  const std::string text = writer.text();
  for (const char* part :
       {"# Length of a side. (m; > 0; must be given)\nsize_m = 4\n",
        "# How weeds are found. (\"direct\" | \"iterative\")\nmethod = \"direct\"\n",
        "# Only with method = \"iterative\":\n# Weeds that stay. (> 0)\n#tolerance = 0.001\n",
        "# Of the water. (m3)\n#volume_m3 = 100\n", "# Of the fence. (m; >= 0; may be left out)\n#height_m = 1.5\n",
        "# Where plants grow.\n#[[beds]]\n# Of the bed. (must be given)\n#name = \"roses\"\n",
        "# Layers. (>= 1 | \"off\")\ndepth = 3\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

/// A study whose defaults follow from a preset.
struct Orchard {
  std::string preset = "small";
  double size_m = 1.0;
  int trees = 2;
  Method method = Method::direct;
  std::optional<double> fence_m;
  std::optional<Garden::Pump> pump;
  std::vector<Garden::Bed> beds{{"first", 3.0}};

  bool operator==(const Orchard&) const = default;
};

void describe(StudyVisitor& visitor, Orchard& orchard) {
  const std::string before = orchard.preset;
  visitor.word({"preset", "Gives the values.", "\"small\""}, orchard.preset,
               Words<std::string>{{"small", "small"}, {"large", "large"}});
  if (visitor.source() != nullptr || orchard.preset != before) {
    const bool is_large = orchard.preset == "large";
    orchard.size_m = is_large ? 10.0 : 1.0;
    orchard.trees = is_large ? 50 : 2;
    orchard.method = is_large ? Method::iterative : Method::direct;
    orchard.beds.front().length_m = is_large ? 30.0 : 3.0;
  }
  visitor.defaults_from("preset", [&] {
    visitor.number({"size_m", "Length of a side."}, orchard.size_m, positive());
    visitor.table({"soil", "Below."}, [&] { visitor.integer({"trees", "How many."}, orchard.trees); });
    visitor.word({"method", "How."}, orchard.method, method_words);
    visitor.optional_number({"fence_m", "Its height.", "1.5"}, orchard.fence_m);
    visitor.optional_table({"pump", "Brings water."}, orchard.pump, [&](Garden::Pump& pump) {
      visitor.number({"flow_m3", "In an hour."}, pump.flow_m3);
    });
    visitor.tables({"beds", "Where plants grow."}, orchard.beds, [&](Garden::Bed& bed) {
      visitor.text({"name", "Of the bed.", "\"roses\""}, bed.name);
      visitor.number({"length_m", "Along the path."}, bed.length_m);
    });
  });
}

Orchard read_orchard(const std::string& text) {
  Orchard orchard;
  read_described(parse_toml(text, "orchard.toml"), orchard);
  return orchard;
}

// A key that the template stated would hide the value of the preset.
TEST(StudyTemplate, LeavesWhatAPresetGivesToThePreset) {
  Orchard told;
  StudyTemplateWriter writer;
  describe(writer, told);
  const std::string text = writer.text();
  for (const char* part :
       {"preset = \"small\"\n", "# Length of a side. (m; > 0)\n#size_m = 1\n", "[soil]\n# How many.\n#trees = 2\n",
        "#method = \"direct\"\n", "#[[beds]]\n", "#length_m = 3\n", "remove its #"})
    EXPECT_NE(("\n" + text).find(part), std::string::npos) << part << "\nis not in\n" << text;
  EXPECT_EQ(read_orchard(text), read_orchard("preset = \"small\""));
  std::string large = text;
  large.replace(large.find("\"small\"\n"), 7, "\"large\"");
  EXPECT_EQ(read_orchard(large), read_orchard("preset = \"large\"")) << large;
  EXPECT_EQ(read_orchard(large).trees, 50);

  const std::vector<std::string> names{"preset = \"large\"", "method = \"iterative\"", "fence_m", "pump"};
  ASSERT_EQ(writer.alternative_count(), names.size());
  for (std::size_t n = 0; n < names.size(); ++n) {
    Orchard other;
    StudyTemplateWriter enabled(n);
    describe(enabled, other);
    EXPECT_EQ(enabled.enabled_name(), names[n]);
    EXPECT_EQ(read_orchard(enabled.text()), other) << enabled.text();
    EXPECT_NE(other, told) << names[n];
  }
}

/// A study with parts that its preset gives no values.
struct Meadow {
  double hay_kg = 5.0;
  bool is_grazed = false;
  bool is_fenced = false;
  double cattle_kg = 0.0;
  std::vector<double> wires_m;
};

void describe(StudyVisitor& visitor, Meadow& meadow) {
  std::string preset = "small";
  visitor.text({"preset", "Gives the values.", "\"small\""}, preset);
  visitor.defaults_from("preset", [&] {
    visitor.number({"hay_kg", "In a year.", "9"}, meadow.hay_kg, positive());
    visitor.only_if(meadow.is_grazed, "a herd", [&] {
      visitor.number({"cattle_kg", "Of an animal.", "600"}, meadow.cattle_kg, positive());
    });
    const auto fence = [&](bool is_fenced) { return [&meadow, is_fenced] { meadow.is_fenced = is_fenced; }; };
    visitor.one_of({{"hedge", !meadow.is_fenced, fence(false),
                     [&] {
                       visitor.boolean({"hedge", "Has one.", "true"}, meadow.is_grazed);
                     }},
                    {"wires_m", meadow.is_fenced, fence(true), [&] {
                       visitor.numbers({"wires_m", "Heights.", "[0.5, 1]"}, meadow.wires_m, positive(), {.fewest = 2});
                     }}});
  });
}

// Where the preset gives no value, a comment with the value of nothing would break the rule of its own key.
TEST(StudyTemplate, ShowsExamplesWhereAPresetGivesNoValue) {
  Meadow told;
  StudyTemplateWriter writer;
  describe(writer, told);
  const std::string text = writer.text();
  for (const char* part : {"#hay_kg = 5\n", "#cattle_kg = 600\n", "#wires_m = [0.5, 1]\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
  EXPECT_EQ(told.cattle_kg, 0.0) << "only shown";
  EXPECT_FALSE(told.is_fenced);
}

/// A study whose forms and parts are tables, which a file has after all keys.
struct Pond {
  enum class Source { spring, pipe, rain };
  Source source = Source::spring;
  bool has_fish = false;
  double flow_m3 = 1.0;
  double length_m = 2.0;
  int fish = 3;
};

void describe(StudyVisitor& visitor, Pond& pond) {
  const auto choose = [&](Pond::Source source) { return [&pond, source] { pond.source = source; }; };
  const auto in_table = [&](std::string_view name) {
    visitor.table({name, "Brings water."}, [&] { visitor.number({"flow_m3", "In an hour."}, pond.flow_m3); });
  };
  visitor.one_of({{"spring", pond.source == Pond::Source::spring, choose(Pond::Source::spring), [&] { in_table("spring"); }},
                  {"pipe", pond.source == Pond::Source::pipe, choose(Pond::Source::pipe), [&] { in_table("pipe"); }},
                  {"rain_m", pond.source == Pond::Source::rain, choose(Pond::Source::rain), [&] {
                     visitor.number({"rain_m", "In a year."}, pond.length_m);
                     in_table("gutter");
                   }}});
  visitor.only_if(pond.has_fish, "fish", [&] {
    visitor.table({"fish", "What swims."}, [&] { visitor.integer({"count", "How many."}, pond.fish); });
  });
}

TEST(StudyTemplate, BreaksLongComments) {
  StudyTemplateWriter writer;
  StudyVisitor& visitor = writer;
  double depth_m = 1.0;
  const std::string word(39, 'w');
  const std::string help = word + ' ' + word + ' ' + word + '.';
  visitor.number({"depth_m", help}, depth_m);
  EXPECT_EQ(writer.text(), "# " + word + ' ' + word + "\n# " + word + ". (m)\ndepth_m = 1\n");
}

TEST(StudyTemplate, SaysBeforeATableWhatItStandsFor) {
  Pond pond;
  StudyTemplateWriter writer;
  describe(writer, pond);
  EXPECT_EQ(writer.text(),
            "# In place of spring:\n# In a year. (m)\n#rain_m = 2\n"
            "\n# Brings water.\n[spring]\n# In an hour. (m3)\nflow_m3 = 1\n"
            "\n# In place of spring:\n# Brings water.\n#[pipe]\n# In an hour. (m3)\n#flow_m3 = 1\n"
            "\n# In place of spring:\n# Brings water.\n#[gutter]\n# In an hour. (m3)\n#flow_m3 = 1\n"
            "\n# Only with fish:\n# What swims.\n#[fish]\n# How many.\n#count = 3\n");
}

TEST(StudySchema, HoldsKindsRangesWordsAndWhatExcludesWhat) {
  Garden garden;
  StudySchemaWriter writer;
  describe(writer, garden);
  const nlohmann::json schema = nlohmann::json::parse(writer.text("a garden"));
  EXPECT_EQ(schema["title"], "a garden");
  EXPECT_EQ(schema["required"], nlohmann::json::array({"size_m"}));
  EXPECT_EQ(schema["additionalProperties"], false);
  const auto& properties = schema["properties"];
  EXPECT_EQ(properties["size_m"],
            (nlohmann::json{{"type", "number"}, {"exclusiveMinimum", 0.0}, {"description", "Length of a side. (m)"}}));
  EXPECT_EQ(properties["cats"]["maximum"], 9.0);
  EXPECT_EQ(properties["cats"]["default"], 2);
  EXPECT_EQ(properties["method"]["enum"], nlohmann::json::array({"direct", "iterative"}));
  EXPECT_TRUE(properties.contains("tolerance"));
  EXPECT_EQ(properties["centre_m"]["minItems"], 3);
  EXPECT_EQ(properties["beds"]["items"]["required"], nlohmann::json::array({"name"}));
  EXPECT_EQ(properties["soil"]["properties"]["depth"]["anyOf"].size(), 2U);
  ASSERT_EQ(schema["allOf"].size(), 1U) << "one of two keys is the default, so that none is needed";
  EXPECT_EQ(schema["allOf"][0]["not"]["required"], nlohmann::json::array({"pressure_Pa", "volume_m3"}));
}

// A list that must be given is empty before it is read. What may follow depends on how many values it then has.
TEST(StudySchema, LeavesOutWhatDependsOnTheLengthOfAList) {
  const auto go_through = [](StudySchemaWriter& writer) {
    StudyVisitor& visitor = writer;
    std::vector<double> knots;
    visitor.numbers({"knots", "Of the net.", "[0, 1]"}, knots, any_number(), {.fewest = 2});
    const double last = knots.empty() ? 1.0 : static_cast<double>(knots.size() - 1);
    double at = 0.0;
    visitor.number({"at", "Where the gate is."}, at, within(0.0, last));
  };
  StudySchemaWriter writer;
  go_through(writer);
  StudySchemaWriter varied(true);
  go_through(varied);
  writer.leave_out_what_differs(varied);
  const nlohmann::json schema = nlohmann::json::parse(writer.text("a fence"));
  EXPECT_EQ(schema["properties"]["knots"]["minItems"], 2);
  EXPECT_EQ(schema["properties"]["at"]["minimum"], 0.0);
  EXPECT_FALSE(schema["properties"]["at"].contains("maximum")) << schema;
}

// What a height may be depends on the size, which the schema does not know.
TEST(StudySchema, LeavesOutWhatDependsOnOtherValues) {
  struct Fence {
    double size_m = 1.0;
    double height_m = 0.5;
    std::vector<double> knots{0.0, 1.0};
  };
  const auto go_through = [](StudySchemaWriter& writer) {
    Fence fence;
    StudyVisitor& visitor = writer;
    visitor.number({"size_m", "Of the garden."}, fence.size_m, positive());
    visitor.number({"height_m", "Of the fence."}, fence.height_m, {.lowest = 0.0, .highest = fence.size_m});
    visitor.numbers({"knots", "Of the net."}, fence.knots);
    double at = 0.0;
    visitor.number({"at", "Where the gate is.", fence.size_m == 1.0 ? "0.5" : ""}, at,
                   {.highest = static_cast<double>(fence.knots.size())});
  };
  StudySchemaWriter writer;
  go_through(writer);
  StudySchemaWriter varied(true);
  go_through(varied);
  writer.leave_out_what_differs(varied);
  const nlohmann::json schema = nlohmann::json::parse(writer.text("a fence"));
  EXPECT_EQ(schema["properties"]["size_m"]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(schema["properties"]["height_m"]["minimum"], 0.0);
  EXPECT_FALSE(schema["properties"]["height_m"].contains("maximum")) << schema;
  EXPECT_FALSE(schema["properties"]["at"].contains("maximum")) << schema;
  EXPECT_FALSE(schema.contains("required")) << schema;
}

TEST(StudyKeys, HaveARowForEveryKey) {
  Garden garden;
  StudyKeyTable table;
  describe(table, garden);
  const auto row = [&](std::string_view name) {
    for (const KeyRow& candidate : table.rows())
      if (candidate.name == name) return candidate;
    ADD_FAILURE() << name;
    return KeyRow{};
  };
  EXPECT_EQ(row("size_m").standard, "must be given");
  EXPECT_EQ(row("size_m").unit, "m");
  EXPECT_EQ(row("tolerance").condition, "method = \"iterative\"");
  EXPECT_EQ(row("beds[].length_m").standard, "1");
  EXPECT_EQ(row("pump.flow_m3").values, "> 0");
  EXPECT_EQ(row("height_m").standard, "none");
  EXPECT_EQ(row("levels").values, "1 or more values, each in [1, 9]");
  EXPECT_EQ(table.rows().size(), 18U);
  EXPECT_NE(table.text().find("size_m"), std::string::npos);
}

TEST(StudyKeys, SayWhichStandInPlaceOfOthers) {
  StudyKeyTable table;
  StudyVisitor& visitor = table;
  bool is_drawn = true;
  std::string text;
  const auto required = [&](std::string_view name) { visitor.text({name, "Of a bed.", "\"roses\""}, text); };
  visitor.one_of({{"rows", is_drawn, [&] { is_drawn = true; }, [&] { required("rows"); }},
                  {"file", !is_drawn, [&] { is_drawn = false; }, [&] { required("file"); }}});
  required("name");
  ASSERT_EQ(table.rows().size(), 3U);
  EXPECT_EQ(table.rows()[0].standard, "one of several");
  EXPECT_EQ(table.rows()[1].standard, "one of several");
  EXPECT_EQ(table.rows()[2].standard, "must be given");
}

}  // namespace
}  // namespace menger::io
