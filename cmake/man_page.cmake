# Writes the man page of a program from its --help:
#   cmake -DPROGRAM=... -DPAGE=... -DHELP2MAN=... -DEXAMPLES=... -P cmake/man_page.cmake
# EXAMPLES is the folder where the studies lie that examples name.
get_filename_component(name ${PROGRAM} NAME)
get_filename_component(folder ${PAGE} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "^[^\n]*" purpose "${help}")
execute_process(
  COMMAND ${HELP2MAN} --no-info --no-discard-stderr --section 1 --manual "menger" --source "menger" --name "${purpose}" ${PROGRAM}
  OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)
# Commands of an example stay on lines of their own.
string(REGEX REPLACE "\\.IP\n(([^.\n][^\n]*\n)+)" ".IP\n.nf\n\\1.fi\n" page "${page}")
file(WRITE ${PAGE} "${page}.SH FILES\n.TP\n\\fI${EXAMPLES}\\fR\nstudies that examples name, below the prefix of the installation (/usr of the Debian package)\n")
