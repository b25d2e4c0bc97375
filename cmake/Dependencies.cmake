# Debian 12 packages; scripts/packages.txt lists them.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto SSL)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMesh REQUIRED)
find_package(spdlog REQUIRED)
find_package(doctest REQUIRED)

pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(LIBLO REQUIRED IMPORTED_TARGET liblo)
add_library(hdf5::hdf5 ALIAS PkgConfig::HDF5)
add_library(deflate::deflate ALIAS PkgConfig::DEFLATE)
add_library(cairo::cairo ALIAS PkgConfig::CAIRO)
pkg_check_modules(HIDAPI REQUIRED IMPORTED_TARGET hidapi-hidraw)
pkg_check_modules(DRM REQUIRED IMPORTED_TARGET libdrm)
add_library(hidapi::hidraw ALIAS PkgConfig::HIDAPI)
add_library(drm::drm ALIAS PkgConfig::DRM)
pkg_check_modules(UMOCKDEV REQUIRED IMPORTED_TARGET umockdev-1.0)
pkg_check_modules(USB REQUIRED IMPORTED_TARGET libusb-1.0)
add_library(usb::usb ALIAS PkgConfig::USB)
add_library(umockdev::umockdev ALIAS PkgConfig::UMOCKDEV)
add_library(liblo::liblo ALIAS PkgConfig::LIBLO)
if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
endif()

# Debian ships valijson's headers with a config whose target name changed over time.
find_package(valijson QUIET)
if(NOT TARGET ValiJSON::valijson)
  add_library(ValiJSON::valijson INTERFACE IMPORTED)
endif()

# OpenCV by module: its own config asks for all of them, and highgui, imgcodecs, videoio and viz drag in Qt, GDAL and
# another VTK. Never link those.
find_path(OPENCV_INCLUDE opencv2/aruco.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(module core imgproc calib3d aruco)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  add_library(opencv::${module} UNKNOWN IMPORTED)
  set_target_properties(opencv::${module} PROPERTIES IMPORTED_LOCATION ${OPENCV_${module}_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE})
endforeach()
target_link_libraries(opencv::imgproc INTERFACE opencv::core)
target_link_libraries(opencv::calib3d INTERFACE opencv::imgproc)
target_link_libraries(opencv::aruco INTERFACE opencv::calib3d)

# Debian's Draco has a tinygltf of its own inside, another than the one we link, under the same names: whichever comes
# first serves both, and frees what the other made. Of its static library all is taken but what reads and writes glTF.
find_library(DRACO_ARCHIVE libdraco.a REQUIRED)
set(DRACO_WITHOUT_GLTF ${CMAKE_BINARY_DIR}/libdraco_without_gltf.a)
configure_file(${DRACO_ARCHIVE} ${DRACO_WITHOUT_GLTF} COPYONLY)
execute_process(COMMAND ${CMAKE_AR} d ${DRACO_WITHOUT_GLTF} gltf_decoder.cc.o gltf_encoder.cc.o gltf_utils.cc.o
                        tiny_gltf_utils.cc.o scene_io.cc.o texture_io.cc.o COMMAND_ERROR_IS_FATAL ANY)
add_library(draco::compression STATIC IMPORTED)
set_target_properties(draco::compression PROPERTIES IMPORTED_LOCATION ${DRACO_WITHOUT_GLTF})

# The window: GLFW, Dear ImGui with its GL3 backend and FreeType builder, and VTK by component.
find_package(glfw3 3.3 REQUIRED)
find_package(Freetype REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS
             CommonColor CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms FiltersCore FiltersGeneral
             FiltersModeling FiltersSources ImagingCore RenderingCore RenderingImage RenderingOpenGL2 RenderingUI)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
add_library(epoxy::epoxy ALIAS PkgConfig::EPOXY)
add_library(glfw::glfw ALIAS glfw)
add_library(vtk::vtk INTERFACE IMPORTED)
target_link_libraries(vtk::vtk INTERFACE ${VTK_LIBRARIES})
find_path(IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED)
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)
add_library(imgui::imgui INTERFACE IMPORTED)
target_include_directories(imgui::imgui SYSTEM INTERFACE ${IMGUI_INCLUDE})
target_link_libraries(imgui::imgui INTERFACE ${IMGUI_LIBRARY} ${STB_LIBRARY} Freetype::Freetype glfw ${CMAKE_DL_LIBS})

# The trigger board's firmware, and the chip that its tests simulate.
find_program(FOCALSTAGE_AVR_GCC avr-gcc)
find_program(FOCALSTAGE_AVR_OBJCOPY avr-objcopy)
find_program(FOCALSTAGE_AVR_SIZE avr-size)
find_path(AVR_LIBC_INCLUDE avr/io.h PATHS /usr/lib/avr/include /usr/avr/include)
find_path(SIMAVR_INCLUDE simavr/sim_avr.h)
find_library(SIMAVR_LIBRARY simavr)
find_library(ELF_LIBRARY elf)
foreach(needed FOCALSTAGE_AVR_GCC FOCALSTAGE_AVR_OBJCOPY FOCALSTAGE_AVR_SIZE AVR_LIBC_INCLUDE SIMAVR_INCLUDE SIMAVR_LIBRARY
        ELF_LIBRARY)
  if(NOT ${needed})
    message(FATAL_ERROR "${needed} was not found: the trigger board's firmware and its tests need the packages gcc-avr, "
                        "avr-libc, binutils-avr, libsimavr-dev and libelf-dev; scripts/install-packages installs them.")
  endif()
endforeach()
add_library(simavr::simavr INTERFACE IMPORTED)
target_include_directories(simavr::simavr SYSTEM INTERFACE ${SIMAVR_INCLUDE})
target_link_libraries(simavr::simavr INTERFACE ${SIMAVR_LIBRARY} ${ELF_LIBRARY})
