# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
# -DMOTEX=the command -DDOC=docs/reference_options.md: fails when the document is not what the command prints.
execute_process(COMMAND ${MOTEX} help --reference OUTPUT_VARIABLE printed RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "motex help --reference failed: ${result}")
endif()
file(READ ${DOC} kept)
if(NOT printed STREQUAL kept)
  message(FATAL_ERROR "docs/reference_options.md is out of date: motex help --reference > docs/reference_options.md")
endif()
