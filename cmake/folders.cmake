# One target per folder of src/, which sees the headers of the folders it depends on and of no others: each folder is reached
# through an include directory of its own that holds nothing but a link to it, so that a wrong #include does not compile.
#
#   rw_folder(geometry DEPENDS base)   makes rw_geometry from src/geometry/*.cpp
function(rw_folder name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPENDS")
  set(source_dir ${PROJECT_SOURCE_DIR}/src/${name})
  set(include_dir ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_dir})
  file(CREATE_LINK ${source_dir} ${include_dir}/${name} SYMBOLIC)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${source_dir}/*.cpp)
  add_library(rw_${name} STATIC ${sources})
  target_include_directories(rw_${name} PUBLIC ${include_dir})
  target_link_libraries(rw_${name} PRIVATE $<BUILD_INTERFACE:rw_warnings>)
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(rw_${name} PUBLIC rw_${dependency})
  endforeach()
endfunction()
