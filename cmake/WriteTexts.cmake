# Writes what PaciniPackage.cmake installs of texts into FOLDER: the manual page and completions of the command PACINI, or
# the manual page NAME(1) of the program PROGRAM from its help.
function(compressed name) # from a command, what is on its output
    execute_process(COMMAND ${ARGN} COMMAND gzip -9n OUTPUT_FILE "${FOLDER}/${name}.gz" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY "${FOLDER}")
if(PACINI)
    compressed(pacini.1 "${PACINI}" man)
    compressed(pacini-bench.1 "${CMAKE_COMMAND}" -E echo ".so man1/pacini.1")
    foreach(shell bash zsh fish)
        string(REPLACE pacini.zsh _pacini file pacini.${shell})
        execute_process(COMMAND "${PACINI}" completions ${shell} OUTPUT_FILE "${FOLDER}/${file}" COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
else()
    execute_process(COMMAND "${PROGRAM}" --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\\" "\\e" help "${help}")
    string(REPLACE "-" "\\-" help "${help}")
    # "Name: what it is.", "Usage: ...", the options.
    if(NOT help MATCHES "^[^:]*: ([^.\n]*)\\.[^\n]*\nUsage: [^\n]*\n\n(.*)\n$")
        message(FATAL_ERROR "${PROGRAM} --help has another form:\n${help}")
    endif()
    string(TOUPPER "${NAME}" title)
    file(WRITE "${FOLDER}/${NAME}.1" ".TH ${title} 1 \"\" \"pacini ${VERSION}\" \"User commands\"\n"
        ".SH NAME\n${NAME} \\- ${CMAKE_MATCH_1}\n.SH SYNOPSIS\n.B ${NAME}\n[\\fIOPTIONS\\fR] ...\n"
        ".SH OPTIONS\n.nf\n${CMAKE_MATCH_2}.fi\n.SH \"SEE ALSO\"\n.BR pacini (1)\n")
    compressed(${NAME}.1 cat "${FOLDER}/${NAME}.1")
endif()
