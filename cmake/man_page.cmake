# Writes the man page of a program from its --help: cmake -DPROGRAM=... -DPAGE=... -DHELP2MAN=... -P cmake/man_page.cmake
get_filename_component(name ${PROGRAM} NAME)
get_filename_component(folder ${PAGE} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "^[^\n]*" purpose "${help}")
execute_process(
  COMMAND ${HELP2MAN} --no-info --no-discard-stderr --section 1 --manual "menger" --source "menger" --name "${purpose}" --output ${PAGE} ${PROGRAM}
  COMMAND_ERROR_IS_FATAL ANY)
