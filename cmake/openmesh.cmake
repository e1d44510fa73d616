# OpenMesh's readers. Debian's package has a CMake config that names no targets of use, so the library is looked up itself.
find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/IO/IOManager.hh REQUIRED)
find_library(OPENMESH_CORE_LIBRARY OpenMeshCore REQUIRED)
add_library(openmesh_core INTERFACE)
target_include_directories(openmesh_core SYSTEM INTERFACE ${OPENMESH_INCLUDE_DIR})
target_link_libraries(openmesh_core INTERFACE ${OPENMESH_CORE_LIBRARY})
# Its headers use M_PI and friends.
target_compile_definitions(openmesh_core INTERFACE _USE_MATH_DEFINES)
