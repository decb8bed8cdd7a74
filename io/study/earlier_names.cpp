#include "io/study/earlier_names.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/study/every_key_visitor.h"

namespace menger::io {
namespace {

/// Finds the keys of a file that have other names now, and learns the earlier names of all keys.
class EarlierNameFinder : public EveryKeyVisitor {
 public:
  explicit EarlierNameFinder(const TomlTable& top) : EveryKeyVisitor(false), top_(top), places_{{"", top}} {}

  /// Returns a message for each key that was found.
  [[nodiscard]] std::vector<std::string> faults() const {
    std::vector<std::string> all = faults_;
    for (const KeyNames& list : lists_) {
      for (std::size_t n = 0; n < list.names.size(); ++n) {
        const auto known = present_names_.find(list.names[n]);
        if (known != present_names_.end()) all.emplace_back(list.table.error(list.key, known->second, std::array{n}).what());
      }
    }
    return all;
  }

 protected:
  void visit(const StudyEntry& entry, std::optional<StudyValue>&) override {
    (void)find(entry.key, false);
    for (auto place = places_.begin() + 1; place != places_.end(); ++place)
      learn(place->prefix + std::string(entry.key.name), entry.key);
    const std::optional<TomlTable>& present = places_.front().table;
    if (!entry.names_keys || !present || !present->has(entry.key.name)) return;
    lists_.push_back({*present, std::string(entry.key.name), present->texts(entry.key.name)});
  }

  void inside(const Key& key, bool is_entry, const std::function<void()>& describe) override {
    const std::string name(key.name);
    find_text(key);
    std::vector<Place> inner = places_;
    for (Place& place : inner) {
      place.prefix += name + ".";
      place.table = place.table && place.table->is_table(name) ? std::optional(place.table->table(name)) : std::nullopt;
    }
    std::vector<Place> earlier = find(key, true);
    inner.insert(inner.end(), earlier.begin(), earlier.end());
    const TomlTable* array = places_.front().table ? &*places_.front().table : nullptr;
    if (!is_entry || array == nullptr || !array->is_array_of_tables(name)) return describe_in(inner, describe);
    const std::vector<TomlTable> entries = array->tables(name);
    for (std::size_t n = 0; n < entries.size(); ++n) {
      inner.front() = {places_.front().prefix + name + "[" + std::to_string(n + 1) + "].", entries[n]};
      describe_in(inner, describe);
    }
  }

 private:
  /// A table of the description where the file may have it.
  struct Place {
    std::string prefix;  ///< path of the table, with a dot at its end
    std::optional<TomlTable> table;
  };
  struct KeyNames {
    TomlTable table;
    std::string key;
    std::vector<std::string> names;
  };

  void describe_in(const std::vector<Place>& places, const std::function<void()>& describe) {
    const std::vector<Place> outer = std::exchange(places_, places);
    describe();
    places_ = outer;
  }

  [[nodiscard]] std::string message(const Key& key) const {
    return "is called " + places_.front().prefix + std::string(key.name) + " now" +
           (key.was_reciprocal ? ", the reciprocal of this number" : "");
  }

  void learn(const std::string& earlier_name, const Key& key) { present_names_.emplace(earlier_name, message(key)); }

  /// Looks for a key by its earlier name. Several alternatives may have the same key, which is reported once.
  /// @return where the earlier table would be, if the key is a table
  std::vector<Place> find(const Key& key, bool is_table) {
    std::vector<Place> found;
    if (key.earlier.empty()) return found;
    const bool is_from_top = key.earlier.front() == '/';
    const std::vector<Place> origins = is_from_top ? std::vector<Place>{{"", top_}} : places_;
    for (Place place : origins) {
      std::string_view rest = is_from_top ? key.earlier.substr(1) : key.earlier;
      for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
        const std::string_view name = rest.substr(0, dot);
        place.prefix.append(name).append(".");
        place.table = place.table && place.table->is_table(name) ? std::optional(place.table->table(name)) : std::nullopt;
        rest.remove_prefix(dot + 1);
      }
      if (!is_table) learn(place.prefix + std::string(rest), key);
      const bool is_there = place.table && place.table->has(rest) && place.table->is_table(rest) == is_table;
      if (is_there) report(place.table->error(rest, message(key)));
      place.prefix.append(rest).append(".");
      place.table = is_there && is_table ? std::optional(place.table->table(rest)) : std::nullopt;
      found.push_back(std::move(place));
    }
    return found;
  }

  void find_text(const Key& key) {
    if (key.earlier_text.empty()) return;
    for (const Place& place : places_) {
      if (!place.table || !place.table->is_text(key.name)) continue;
      report(place.table->error(key.name, "is called " + places_.front().prefix + std::string(key.earlier_text) + " now"));
    }
  }

  void report(const InputError& fault) {
    if (std::ranges::find(faults_, fault.what()) == faults_.end()) faults_.emplace_back(fault.what());
  }

  TomlTable top_;
  std::vector<Place> places_;  ///< the first one has the present name, the others have earlier ones
  std::vector<std::string> faults_{};
  std::map<std::string, std::string, std::less<>> present_names_{};  ///< messages by earlier names
  std::vector<KeyNames> lists_{};
};

}  // namespace

void refuse_earlier_names(const TomlTable& top, const std::function<void(StudyVisitor&)>& describe_default) {
  EarlierNameFinder finder(top.unasked());
  describe_default(finder);
  std::string message;
  for (const std::string& fault : finder.faults()) message.append(message.empty() ? "" : "\n").append(fault);
  if (!message.empty()) throw InputError(message);
}

}  // namespace menger::io
