#include "io/process/study_help.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>

#include "io/study/study_keys.h"
#include "io/study/study_schema.h"
#include "io/study/study_template.h"

namespace menger::io {

void add_study_help(CLI::App& app, const std::function<void(StudyVisitor&)>& describe_default) {
  const std::string command = app.get_name();
  const auto end_with = [](const std::string& text) {
    std::cout << text << std::flush;
    throw CLI::Success();
  };
  const auto print_template = [=] {
    StudyTemplateWriter writer;
    describe_default(writer);
    end_with("# A study of " + command + ". Values are the defaults; keys that must be given have an example.\n\n" +
             writer.text());
  };
  const auto print_schema = [=] {
    StudySchemaWriter writer;
    describe_default(writer);
    StudySchemaWriter varied(true);
    describe_default(varied);
    writer.leave_out_what_differs(varied);
    end_with(writer.text("study of " + command));
  };
  const auto print_keys = [=] {
    StudyKeyTable table;
    describe_default(table);
    end_with(table.text());
  };
  app.add_flag_callback("--template", print_template, "Print a study with every key, its meaning and its default, and exit");
  app.add_flag_callback("--schema", print_schema, "Print a JSON Schema of studies, for editors, and exit");
  app.add_flag_callback("--keys", print_keys, "Print a table of the keys of a study and exit");
}

}  // namespace menger::io
