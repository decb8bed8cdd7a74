#include "io/study/study_schema.h"

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

/// A table while it is described.
struct StudySchemaWriter::Table {
  Json properties = Json::object();
  Json required = Json::array();
  Json demands = Json::array();  ///< on which keys stand together

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

StudySchemaWriter::StudySchemaWriter() : top_(std::make_unique<Table>()), table_(top_.get()) {}
StudySchemaWriter::~StudySchemaWriter() = default;

std::string StudySchemaWriter::text(std::string_view title) const {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(top_->schema());
  return schema.dump(2) + "\n";
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
    if (!may_be_missing_) table_->required.push_back(entry.key.name);
  } else if (value) {
    schema["default"] = value_json(*value);
  }
  table_->add(entry.key.name, std::move(schema));
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
  const Alternative* chosen = nullptr;
  const bool outer = std::exchange(may_be_missing_, true);
  for (const Alternative& alternative : alternatives) {
    if (alternative.is_chosen) chosen = &alternative;
    alternative.choose();
    alternative.describe();
  }
  may_be_missing_ = outer;
  if (chosen != nullptr) chosen->choose();
  Json keys = Json::array();
  for (const Alternative& alternative : alternatives) keys.push_back(Json{{"required", Json::array({alternative.key})}});
  for (std::size_t a = 0; a < alternatives.size(); ++a) {
    for (std::size_t b = a + 1; b < alternatives.size(); ++b)
      table_->demands.push_back(Json{{"not", {{"required", Json::array({alternatives[a].key, alternatives[b].key})}}}});
  }
  const bool must_have_one = chosen == nullptr && !missing.empty();
  if (must_have_one && !may_be_missing_) table_->demands.push_back(Json{{"anyOf", keys}});
}

void StudySchemaWriter::visit_branch(bool holds, std::string_view, const std::function<void()>& describe) {
  if (holds) return describe();
  const bool outer = std::exchange(may_be_missing_, true);
  describe();
  may_be_missing_ = outer;
}

}  // namespace menger::io
