# The warnings of this project, as an interface target: errors where the tests are built, so that a newer compiler's new
# warning does not keep a user from building.
option(RAYWISE_WARNINGS_AS_ERRORS "Treat warnings as errors" ${RAYWISE_BUILD_TESTS})
add_library(rw_warnings INTERFACE)
target_compile_options(rw_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wundef
  $<$<BOOL:${RAYWISE_WARNINGS_AS_ERRORS}>:-Werror>
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align>)
