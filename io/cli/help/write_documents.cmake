# Writes the manual pages, the completion scripts and the schemas that the program prints:
# cmake -DPROGRAM=viscard -DFOLDER=build -P write_documents.cmake
function(write_output file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${FOLDER}/${file} "${text}")
endfunction()

file(REMOVE_RECURSE ${FOLDER}/schemas)
execute_process(COMMAND ${PROGRAM} help --schemas ${FOLDER}/schemas --json OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH ${list} commands)
math(EXPR last "${count} - 1")
file(REMOVE_RECURSE ${FOLDER}/man ${FOLDER}/completions)  # pages of commands that are no more
foreach(i RANGE ${last})
  string(JSON name GET ${list} commands ${i} name)
  write_output(man/viscard-${name}.1 help --man ${name})
endforeach()
write_output(completions/viscard.bash completion bash)
write_output(completions/_viscard completion zsh)
write_output(completions/viscard.fish completion fish)
write_output(man/viscard.1 help --man)
