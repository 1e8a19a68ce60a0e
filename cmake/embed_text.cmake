# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT

# motex_embed_text(target header variable files...): at build time the files, one after another, become
#   extern const std::string_view motex::<variable>
# declared in `header` (as it is included) and compiled into the target.
function(motex_embed_text target header variable)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${variable}.cpp)
  string(REPLACE ";" "|" inputs "${ARGN}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -DVARIABLE=${variable} "-DINPUTS=${inputs}" -DOUTPUT=${output}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake VERBATIM)
  target_sources(${target} PRIVATE ${output})
  # Both compilers take literals longer than the standard asks for; clang warns.
  set_source_files_properties(${output} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" inputs "${INPUTS}")
  set(text "")
  foreach(input IN LISTS inputs)
    file(READ ${input} part)
    if(part MATCHES "\\)embedded\"")
      message(FATAL_ERROR "${input} holds the mark that ends an embedded text")
    endif()
    string(APPEND text "${part}")
  endforeach()
  file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\nnamespace motex {\nconst std::string_view ${VARIABLE} = R\"embedded(${text})embedded\";\n}\n")
endif()
