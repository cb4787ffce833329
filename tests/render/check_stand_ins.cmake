# Checks the suite scenes/stand_ins.toml in STAGE, a folder with report/models: copies of the scenes go beside them.
# With UPDATE the golden images are made anew instead, and brought back.
file(COPY "${SCENES}/stand_ins.toml" "${SCENES}/golden" DESTINATION "${STAGE}")
file(GLOB scenes "${SCENES}/report/*.json")
file(COPY ${scenes} "${SCENES}/report/parts" "${SCENES}/report/textures" DESTINATION "${STAGE}/report")
set(words "")
if(UPDATE)
  set(words --update)
endif()
execute_process(COMMAND "${CANDIL}" check stand_ins.toml --output results ${words} WORKING_DIRECTORY "${STAGE}"
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "candil check: ${status}")
endif()
if(UPDATE)
  file(GLOB golden "${STAGE}/golden/stand_in_*.exr")
  file(COPY ${golden} DESTINATION "${SCENES}/golden")
endif()
