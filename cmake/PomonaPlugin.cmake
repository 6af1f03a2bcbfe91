# pomona_add_plugin(NAME SOURCES...)
#
# A plugin, NAME.so, of whose symbols the program that loads it sees one only. Part of the installed package.
function(pomona_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE pomona::pomona)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_options(${name} PRIVATE -Wl,--exclude-libs,ALL)
endfunction()
