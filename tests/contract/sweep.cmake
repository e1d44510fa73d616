# Sweeps over random rays and edges, and the reports of the desk target. Included by CMakeLists.txt.
add_library(rw_contract_sweep STATIC
  report_json.cpp
  sweep_agreement.cpp
  sweep_closed.cpp
  sweep_closed_scenes.cpp
  sweep_compare.cpp
  sweep_edge_rays.cpp
  sweep_layout.cpp
  sweep_manner.cpp
  sweep_rays.cpp
  sweep_result.cpp
  sweep_scenes.cpp
  sweep_schedule.cpp
  sweep_subject.cpp
  sweep_watertight.cpp
  ${PROJECT_SOURCE_DIR}/calibration/progress_bar.cpp
)
target_link_libraries(rw_contract_sweep
  PUBLIC raywise rw_oracle rw_base raywise_workloads nlohmann_json::nlohmann_json
  PRIVATE raywise_calibration rw_model Threads::Threads rw_warnings)

add_executable(contract_sweep sweep_main.cpp)
target_link_libraries(contract_sweep PRIVATE rw_contract_sweep CLI11::CLI11 rw_warnings)
add_executable(contract_report report_main.cpp)
target_link_libraries(contract_report PRIVATE rw_contract_sweep CLI11::CLI11 rw_warnings)

foreach(name closed rays compare schedule)
  rw_add_test(contract_sweep_${name}_test SOURCES sweep_${name}_test.cpp LIBS rw_contract_sweep
    LABELS contract ENVIRONMENT RAYWISE_CALIBRATION=builtin)
endforeach()
rw_add_test(contract_report_test SOURCES report_test.cpp LIBS rw_contract_sweep LABELS contract)

# The short form of the sweeps: 10^7 comparisons and 10^6 edge rays together, in entries that can run side by side. What is
# instrumented or not optimised takes ten times as long per ray.
set(share 100)
if(RAYWISE_SANITIZE OR RAYWISE_COVERAGE OR CMAKE_BUILD_TYPE STREQUAL Debug)
  set(share 4)
endif()
function(add_short_sweep name comparisons edge_rays)
  math(EXPR comparisons "${comparisons} * ${share} / 100")
  math(EXPR edge_rays "${edge_rays} * ${share} / 100")
  add_test(NAME contract_sweep_${name} COMMAND contract_sweep
    --comparisons ${comparisons} --edge-rays ${edge_rays} --threads 1 ${ARGN})
  set_tests_properties(contract_sweep_${name} PROPERTIES
    TIMEOUT 1200 LABELS contract ENVIRONMENT RAYWISE_CALIBRATION=builtin)
endfunction()
add_short_sweep(hard 6000000 0 --families hard)
add_short_sweep(procedural 3000000 0 --families procedural --sizes 300,3000)
# Without the data folder there are no real meshes: then procedural ones make up the number.
add_short_sweep(real 1500000 0 --families real,procedural --sizes 1000 --most-triangles 20000)
add_short_sweep(edges 0 1000000 --families hard --most-triangles 25000)
