# cmake -DSOURCE=<tree> -DHEADER=<file> -P write_commit.cmake: defines TUNICA_COMMIT in HEADER, which changes only with
# the commit, so that nothing is compiled in vain.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define TUNICA_COMMIT \"${commit}\"\n")
