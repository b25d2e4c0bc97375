# One place for what every target of ours is compiled with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

option(FOCALSTAGE_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
option(FOCALSTAGE_COVERAGE "Coverage counters" OFF)
option(FOCALSTAGE_FUZZ "Link the fuzz targets with libFuzzer (clang)" OFF)

find_program(FOCALSTAGE_CCACHE ccache)
if(FOCALSTAGE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${FOCALSTAGE_CCACHE})
endif()

add_library(focalstage_options INTERFACE)
target_include_directories(focalstage_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(focalstage_options INTERFACE GLM_FORCE_CTOR_INIT GLM_ENABLE_EXPERIMENTAL)
# The same bytes everywhere: x86-64-v2 is the floor, products and sums are never fused, no fast-math.
target_compile_options(focalstage_options INTERFACE -march=x86-64-v2 -ffp-contract=off -fno-fast-math)
target_compile_options(focalstage_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Wold-style-cast -Wcast-align -Woverloaded-virtual -Werror)
# -Wrestrict: GCC 12 warns about "literal" + std::string where there is nothing (its bug 105651).
target_compile_options(focalstage_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi -Wno-restrict>)
if(FOCALSTAGE_SANITIZE)
  target_compile_options(focalstage_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
  # GCC's own manual: with sanitizers this warning sees what is not there (in std::regex, for one).
  target_compile_options(focalstage_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(focalstage_options INTERFACE -fsanitize=address,undefined)
endif()
if(FOCALSTAGE_FUZZ)
  target_compile_options(focalstage_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(focalstage_options INTERFACE -fsanitize=address,undefined)
endif()
if(FOCALSTAGE_COVERAGE)
  target_compile_options(focalstage_options INTERFACE --coverage)
  target_link_options(focalstage_options INTERFACE --coverage)
endif()
