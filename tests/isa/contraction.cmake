# Which sources a look for contraction has to see compiled differently, and which it leaves out.
#
# Sources that ask for std::fma, or include the header that does, are compiled again with a call in its place, so that what is left
# would be the compiler's own doing. area_check.cpp asks for fused operations in a bound on rounding, and no hit depends on it.

# Sets ASKING to those of SOURCES, and CHECKED to OBJECTS without theirs.
function(isa_split_asking asking checked objects)
  set(asking_sources)
  set(left ${objects})
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} asks REGEX "std::fma\\(|base/expansion.h" LIMIT_COUNT 1)
    if(asks)
      list(APPEND asking_sources ${source})
    endif()
  endforeach()
  foreach(source IN LISTS asking_sources ITEMS area_check.cpp)
    get_filename_component(name ${source} NAME)
    set(left $<FILTER:${left},EXCLUDE,/${name}\\.o$>)
  endforeach()
  set(${asking} ${asking_sources} PARENT_SCOPE)
  set(${checked} ${left} PARENT_SCOPE)
endfunction()
