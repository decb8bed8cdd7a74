#include "io/study/study_schema.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/study/key_text.h"

namespace menger::io {
namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const StudyEntry& entry, const char* type) {
  Json schema{{"type", type}};
  const Range& range = entry.range;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (range.lowest > -infinity) schema[range.lowest_excluded ? "exclusiveMinimum" : "minimum"] = range.lowest;
  if (range.highest < infinity) schema[range.highest_excluded ? "exclusiveMaximum" : "maximum"] = range.highest;
  return schema;
}

Json text_schema(const StudyEntry& entry) {
  Json schema{{"type", "string"}};
  if (!entry.words.empty()) schema["enum"] = entry.words;
  return schema;
}

Json list_schema(const StudyEntry& entry, Json each) {
  Json schema{{"type", "array"}, {"items", std::move(each)}};
  if (entry.count.fewest > 0) schema["minItems"] = entry.count.fewest;
  if (entry.count.most < Count{}.most) schema["maxItems"] = entry.count.most;
  return schema;
}

Json value_schema(const StudyEntry& entry) {
  switch (entry.kind) {
    case ValueKind::boolean:
      return {{"type", "boolean"}};
    case ValueKind::integer:
      if (!entry.words.empty()) return {{"anyOf", Json::array({number_schema(entry, "integer"), text_schema(entry)})}};
      return number_schema(entry, "integer");
    case ValueKind::number:
      return number_schema(entry, "number");
    case ValueKind::path:
      return {{"type", "string"}, {"minLength", 1}};
    case ValueKind::text:
      return text_schema(entry);
    case ValueKind::integers:
      return list_schema(entry, number_schema(entry, "integer"));
    case ValueKind::numbers:
      return list_schema(entry, number_schema(entry, "number"));
    case ValueKind::texts:
      return list_schema(entry, text_schema(entry));
    case ValueKind::text_rows:
      break;
  }
  return list_schema(entry, list_schema(entry, text_schema(entry)));
}

/// Returns a number in the range that is probably not the default.
double varied_number(const Range& range) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double span = range.highest < infinity && range.lowest > -infinity ? range.highest - range.lowest : 1.0;
  if (range.lowest > -infinity) return range.lowest + 0.37 * span;
  return range.highest < infinity ? range.highest - 0.37 * span : 0.37;
}

/// Returns another value that the key accepts, if one is easy to find; otherwise the same value.
std::optional<StudyValue> varied(const StudyEntry& entry, std::optional<StudyValue> value) {
  if (!value) return value;
  if (auto* truth = std::get_if<bool>(&*value)) *truth = !*truth;
  if (auto* number = std::get_if<double>(&*value)) *number = varied_number(entry.range);
  if (auto* numbers = std::get_if<std::vector<double>>(&*value))
    numbers->assign(std::min(std::max(numbers->size(), entry.count.fewest) + 2, entry.count.most), varied_number(entry.range));
  if (auto* text = std::get_if<std::string>(&*value)) {
    const auto other = std::ranges::find_if(entry.words, [&](std::string_view word) { return word != *text; });
    if (other != entry.words.end()) *text = *other;
  }
  return value;
}

/// Removes from a schema those demands on values (ranges, lengths, required keys) that another schema of the same study does not
/// have.
void keep_common(Json& schema, const Json& other) {
  if (schema.is_array()) {
    for (std::size_t n = 0; n < schema.size() && other.is_array() && n < other.size(); ++n) keep_common(schema[n], other[n]);
    return;
  }
  if (!schema.is_object() || !other.is_object()) return;
  for (const char* demand : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "minItems", "maxItems"}) {
    if (schema.contains(demand) && (!other.contains(demand) || other[demand] != schema[demand])) schema.erase(demand);
  }
  if (schema.contains("required") && schema["required"].is_array()) {
    Json common = Json::array();
    for (const Json& key : schema["required"]) {
      const Json none = Json::array();
      const Json& others = other.contains("required") ? other["required"] : none;
      if (std::ranges::find(others, key) != others.end()) common.push_back(key);
    }
    schema["required"] = common;
  }
  for (const auto& [key, inner] : schema.items()) {
    if (key != "required" && other.contains(key)) keep_common(inner, other[key]);
  }
}

Json value_json(const StudyValue& value) {
  return std::visit(
      [](const auto& any) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(any)>, std::filesystem::path>)
          return any.string();
        else
          return any;
      },
      value);
}

}  // namespace

/// The schema of a table under construction.
struct StudySchemaWriter::Table {
  Json properties = Json::object();
  Json required = Json::array();
  Json demands = Json::array();  ///< on which keys may or must be present together

  void add(std::string_view name, Json schema) {
    Json& known = properties[std::string(name)];
    if (known.is_null() || known == schema) {
      known = std::move(schema);
    } else if (known.contains("anyOf") && known.size() == 1) {
      known["anyOf"].push_back(std::move(schema));
    } else {
      known = Json{{"anyOf", Json::array({std::move(known), std::move(schema)})}};
    }
  }

  [[nodiscard]] Json schema() const {
    Json all{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) all["required"] = required;
    if (!demands.empty()) all["allOf"] = demands;
    return all;
  }
};

StudySchemaWriter::StudySchemaWriter(bool varies) : top_(std::make_unique<Table>()), table_(top_.get()), varies_(varies) {}
StudySchemaWriter::~StudySchemaWriter() = default;

std::string StudySchemaWriter::text(std::string_view title) const {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(top_->schema());
  return schema.dump(2) + "\n";
}

void StudySchemaWriter::leave_out_what_differs(const StudySchemaWriter& varied) {
  Json common = top_->schema();
  keep_common(common, varied.top_->schema());
  top_->properties = common["properties"];
  top_->required = common.value("required", Json::array());
}

void StudySchemaWriter::inside(Table& table, const std::function<void()>& describe) {
  Table* const outer = std::exchange(table_, &table);
  const bool outer_may = std::exchange(may_be_missing_, false);
  describe();
  may_be_missing_ = outer_may;
  table_ = outer;
}

void StudySchemaWriter::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  Json schema = value_schema(entry);
  const std::string unit = unit_of(entry.key.name);
  schema["description"] = std::string(entry.key.help) + (unit.empty() ? "" : " (" + unit + ")");
  if (entry.is_required()) {
    if (!may_be_missing_ && !entry.key.may_be_elsewhere) table_->required.push_back(entry.key.name);
  } else if (value) {
    schema["default"] = value_json(*value);
  }
  table_->add(entry.key.name, std::move(schema));
  if (varies_) value = varied(entry, value);
}

void StudySchemaWriter::visit_table(const Key& key, const std::function<void()>& describe) {
  Table table;
  inside(table, describe);
  const bool is_required = !key.example.empty() || !table.required.empty();
  if (is_required && !may_be_missing_) table_->required.push_back(key.name);
  Json schema = table.schema();
  schema["description"] = key.help;
  table_->add(key.name, std::move(schema));
}

void StudySchemaWriter::visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                             const std::function<void()>& describe) {
  set(true);
  Table table;
  inside(table, describe);
  set(has);
  Json schema = table.schema();
  schema["description"] = key.help;
  table_->add(key.name, std::move(schema));
}

void StudySchemaWriter::visit_tables(const Key& key, const Count& count, std::size_t size,
                                     const std::function<void(std::size_t)>& resize,
                                     const std::function<void(std::size_t)>& describe) {
  if (size == 0) resize(1);
  Table table;
  inside(table, [&] { describe(0); });
  if (size == 0) resize(0);
  Json schema{{"type", "array"}, {"items", table.schema()}, {"description", key.help}};
  if (count.fewest > 0) schema["minItems"] = count.fewest;
  if (count.most < Count{}.most) schema["maxItems"] = count.most;
  if (count.fewest > 0 && !may_be_missing_) table_->required.push_back(key.name);
  table_->add(key.name, std::move(schema));
}

void StudySchemaWriter::visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) {
  const auto found = std::ranges::find_if(alternatives, &Alternative::is_chosen);
  const Alternative* const chosen = found == alternatives.end() ? nullptr : &*found;
  // The chosen alternative comes last, so that the study has this form for the keys that follow.
  const Alternative& last = chosen != nullptr ? *chosen : alternatives.front();
  const auto go_through = [](const Alternative& alternative) {
    if (alternative.is_for_programs) return;
    alternative.choose();
    alternative.describe();
  };
  const bool outer = std::exchange(may_be_missing_, true);
  for (const Alternative& alternative : alternatives) {
    if (&alternative != &last) go_through(alternative);
  }
  go_through(last);
  may_be_missing_ = outer;
  Json keys = Json::array();
  for (const Alternative& alternative : alternatives) keys.push_back(Json{{"required", Json::array({alternative.key})}});
  for (std::size_t a = 0; a < alternatives.size(); ++a) {
    for (std::size_t b = a + 1; b < alternatives.size(); ++b)
      table_->demands.push_back(Json{{"not", {{"required", Json::array({alternatives[a].key, alternatives[b].key})}}}});
  }
  const bool must_have_one = chosen == nullptr && !missing.empty();
  if (must_have_one && !may_be_missing_) table_->demands.push_back(Json{{"anyOf", keys}});
}

void StudySchemaWriter::visit_branch(bool, std::string_view, const std::function<void()>& describe) {
  const bool outer = std::exchange(may_be_missing_, true);
  describe();
  may_be_missing_ = outer;
}

}  // namespace menger::io
