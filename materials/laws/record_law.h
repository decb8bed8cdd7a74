#pragma once

#include <cstddef>

#include "io/text/toml_document.h"
#include "materials/laws/silicone_record.h"

namespace menger::materials {

/// Whether the key `law` of a table holds a law itself, as a table that read_law reads, and not the name of one of a record.
bool has_inline_law(const io::TomlTable& table);

/// One of the laws of a record.
struct RecordLaw {
  SourcedLaw law;
  std::size_t variant = 1;  ///< which of those of its name, from 1
  std::size_t count = 0;    ///< how many of its name the record has; 0: the recommended law
};

/// The law that a table asks for among those of a record: `law` ("recommended", or the name of a law) and `law_variant` (1).
/// @throws io::InputError naming the key and what the record has
RecordLaw choose_law(const io::TomlTable& table, const SiliconeRecord& record);

}  // namespace menger::materials
