# Man pages from the program's own help, by help2man:
#   cmake -D CONTENSOU=PROGRAM -D HELP2MAN=PROGRAM -D VERBS=NAMES -D TOPICS=NAMES -D OUT=FOLDER -P manuals.cmake
function(contensou_help topic result)
  execute_process(COMMAND ${CONTENSOU} help ${topic} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# help2man hands the program's name to a shell, which would cut a path at a blank.
cmake_path(GET CONTENSOU PARENT_PATH folder)
cmake_path(GET CONTENSOU FILENAME program)

foreach(verb IN ITEMS "" LISTS VERBS)
  string(REGEX REPLACE "-$" "" page "contensou-${verb}")
  contensou_help("${verb}" help)
  string(REGEX MATCH "^[^\n]*" summary "${help}")
  set(include "[name]\n${page} \\- ${summary}\n")
  if(verb)
    string(APPEND include "[see also]\n.BR contensou (1)\n")
  else()
    string(APPEND include "[see also]\n")
    foreach(topic IN LISTS TOPICS)
      string(APPEND include ".BR contensou-${topic} (7)\n")
    endforeach()
  endif()
  file(WRITE ${OUT}/include "${include}")
  execute_process(COMMAND ${HELP2MAN} --no-info --include=${OUT}/include --output=${OUT}/${page}.1 "--help-option=help ${verb}"
    ./${program} WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
  # The lines of an example keep their line ends, between .nf and .fi. Without .IP they fit into 80 columns.
  file(READ ${OUT}/${page}.1 manual)
  string(REGEX REPLACE "(\n\\.SH EXAMPLES\n)\\.IP\n(([^.\n][^\n]*\n)+)" "\\1.nf\n\\2.fi\n" manual "${manual}")
  file(WRITE ${OUT}/${page}.1 "${manual}")
endforeach()
file(REMOVE ${OUT}/include)

# The text of a topic already has lines of at most 80 columns. The manual page neither indents nor fills this text.
foreach(topic IN LISTS TOPICS)
  contensou_help(${topic} text)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "\n" "\n\\&" text "\n${text}")  # a dot or an apostrophe would begin a request
  string(TOUPPER ${topic} title)
  file(WRITE ${OUT}/../man7/contensou-${topic}.7 ".TH CONTENSOU-${title} 7 \"\" contensou \"Topics of contensou\"
.SH NAME
contensou-${topic} \\- topic ${topic} of contensou
.SH DESCRIPTION
.in 0
.nf${text}
.fi
.SH \"SEE ALSO\"
.BR contensou (1)
")
endforeach()
