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
