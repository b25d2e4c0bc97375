# The architecture, as a table: every room and the rooms it may see. Top to bottom, nobody sees what stands below.

# core: the model and the mathematics; no file, socket, window, device or clock
focalstage_room(core/base       LIBS glm::glm                      PRIVATE_LIBS Boost::headers)
focalstage_room(core/mesh       USES core/base)
focalstage_room(core/scene      USES core/base core/mesh)
focalstage_room(core/process    USES core/scene core/mesh core/base          PRIVATE_LIBS OpenMeshCore OpenMeshTools)
focalstage_room(core/stage      USES core/process core/scene core/mesh)
focalstage_room(core/optics     USES core/stage core/scene)
focalstage_room(core/compile    USES core/optics core/stage        PRIVATE_LIBS TBB::tbb)
focalstage_room(core/retina     USES core/optics core/stage        PRIVATE_LIBS TBB::tbb)
focalstage_room(core/reference  USES core/retina core/compile core/optics core/stage PRIVATE_LIBS embree TBB::tbb)
focalstage_room(core/sensitivity USES core/reference core/optics core/stage core/scene core/mesh core/base)
focalstage_room(core/schedule   USES core/optics core/scene)
focalstage_room(core/percept    USES core/retina core/schedule core/compile core/optics core/stage PRIVATE_LIBS TBB::tbb)
focalstage_room(core/tracking   USES core/scene core/base)
focalstage_room(core/study      USES core/base)
focalstage_room(core/rig_measure USES core/scene core/base          PRIVATE_LIBS Eigen3::Eigen)
focalstage_room(core/stripes    USES core/base                     PRIVATE_LIBS Eigen3::Eigen)
focalstage_room(core/calibrate  USES core/stripes core/optics core/stage core/scene core/base
                                PRIVATE_LIBS opencv::aruco opencv::calib3d opencv::core Eigen3::Eigen)
focalstage_room(core/check      USES core/process core/percept core/compile core/schedule core/optics core/scene)

# io: everything that becomes bytes
focalstage_room(io/files        USES core/base                     PRIVATE_LIBS OpenSSL::Crypto)
focalstage_room(io/json         USES core/scene                    PRIVATE_LIBS nlohmann_json::nlohmann_json)
focalstage_room(io/image        USES io/files core/mesh            PRIVATE_LIBS PNG::PNG JPEG::JPEG)
focalstage_room(io/project      USES io/json io/files core/scene   PRIVATE_LIBS ValiJSON::valijson nlohmann_json::nlohmann_json)
focalstage_room(io/models       USES io/project io/json io/files core/schedule core/scene)
focalstage_room(io/journal      USES io/json io/files core/scene)
focalstage_room(io/assets       USES io/image io/files core/scene core/mesh PRIVATE_LIBS TinyGLTF::TinyGLTF draco::compression nlohmann_json::nlohmann_json)
focalstage_room(io/study        USES io/project io/json io/files core/study core/scene)
focalstage_room(io/show         USES io/project io/assets io/files core/schedule core/compile core/stage
                                PRIVATE_LIBS hdf5::hdf5 deflate::deflate TBB::tbb)
focalstage_room(io/export       USES io/show io/image io/files      PRIVATE_LIBS TBB::tbb)
focalstage_room(io/plot         USES core/base                     PRIVATE_LIBS cairo::cairo)
focalstage_room(io/credentials  USES io/files core/base            PRIVATE_LIBS OpenSSL::Crypto OpenSSL::SSL)
focalstage_room(io/protocol     USES io/credentials io/project io/assets io/json io/files core/check core/compile core/rig_measure core/scene)
focalstage_room(io/rig_config   USES io/project io/json io/files core/rig_measure core/scene core/base)

# devices: the rig; drivers see only core
focalstage_room(devices/roles   USES core/base)
focalstage_room(devices/serial  USES devices/roles core/base)
focalstage_room(devices/sim     USES devices/roles core/base)
focalstage_room(devices/rig     USES devices/roles core/base)
focalstage_room(devices/natnet  USES devices/roles core/base)
focalstage_room(devices/planes  USES core/base)
focalstage_room(devices/display USES core/base)
focalstage_room(devices/display_kms USES devices/display devices/roles core/base LIBS drm::drm)
focalstage_room(devices/display_glfw USES devices/display devices/roles core/base PRIVATE_LIBS glfw::glfw epoxy::epoxy)
focalstage_room(devices/lightcrafter USES devices/display devices/planes devices/roles core/base PRIVATE_LIBS hidapi::hidraw)
focalstage_room(devices/usb     USES core/base                     PRIVATE_LIBS usb::usb)
focalstage_room(devices/mcc1208 USES devices/usb devices/roles core/base)
focalstage_room(devices/optotune USES devices/serial devices/roles core/base)
focalstage_room(devices/sample  USES devices/roles core/base)
focalstage_room(devices/input   USES devices/roles core/base       PRIVATE_LIBS hidapi::hidraw)
focalstage_room(devices/plugin  USES devices/roles core/base       PRIVATE_LIBS ${CMAKE_DL_LIBS} Threads::Threads)
focalstage_room(devices/recording USES devices/roles core/base)
focalstage_room(devices/camera  USES devices/roles core/base)
focalstage_room(devices/aruco   USES devices/roles core/base       PRIVATE_LIBS opencv::aruco opencv::calib3d opencv::core)
focalstage_room(devices/player  USES devices/roles io/show core/schedule)
focalstage_room(devices/uno     USES devices/serial devices/roles core/base)
focalstage_room(devices/catalog USES devices/uno devices/mcc1208 devices/plugin devices/natnet devices/recording devices/aruco devices/camera
                                     devices/lightcrafter devices/display_kms devices/display devices/optotune devices/serial devices/rig devices/roles io/rig_config core/scene core/base)
focalstage_room(devices/runtime USES devices/catalog devices/rig devices/player devices/sim devices/recording devices/roles io/show io/project io/assets
                                     io/json io/models io/protocol io/credentials io/rig_config io/files core/check core/compile core/rig_measure core/schedule
                                     core/stage core/tracking
                                PRIVATE_LIBS spdlog::spdlog gRPC::grpc++ gRPC::grpc++_reflection)
# C for a microcontroller, a program of its own: on this side only its tests
focalstage_room(devices/firmware)
focalstage_room(devices/service USES devices/runtime io/protocol io/rig_config io/json core/base
                                LIBS spdlog::spdlog PRIVATE_LIBS liblo::liblo)

# editor: what people touch
focalstage_room(editor/samples  USES io/files core/base)
focalstage_room(editor/pipeline USES io/models io/project io/assets io/show core/check core/reference core/compile core/percept core/retina
                                     core/schedule)
focalstage_room(editor/trials   USES editor/pipeline io/study io/protocol io/show io/project core/study)
focalstage_room(editor/viewer   USES editor/trials editor/pipeline io/study io/protocol io/show io/project io/assets io/files core/reference core/retina
                                     core/optics core/stage core/study core/scene core/base)
focalstage_room(editor/cli      USES editor/samples editor/pipeline editor/trials editor/viewer io/study io/models io/project io/assets io/show io/export io/plot
                                     io/credentials io/protocol io/image core/calibrate core/rig_measure core/check core/reference core/sensitivity core/compile core/percept
                                     core/retina core/schedule
                                PRIVATE_LIBS CLI11::CLI11)
focalstage_room(editor/document USES editor/samples io/journal io/models io/project io/assets io/files core/scene)
focalstage_room(editor/tools    USES core/percept core/compile core/stage core/optics core/scene core/mesh)
focalstage_room(editor/preview  USES editor/tools core/check core/compile core/reference core/percept core/retina core/schedule
                                     core/stage)
focalstage_room(editor/rig      USES io/protocol io/project io/assets io/files)
focalstage_room(editor/session  USES editor/tools editor/document editor/preview editor/rig editor/pipeline io/models io/export io/image
                                     core/sensitivity core/schedule)

# the window: GLFW, Dear ImGui and VTK live here and nowhere else
focalstage_room(editor/window/base   USES editor/session           LIBS imgui::imgui vtk::vtk PRIVATE_LIBS epoxy::epoxy)
focalstage_room(editor/window/views  USES editor/window/base editor/tools)
focalstage_room(editor/window/panels USES editor/window/base)
focalstage_room(editor/window/app    USES editor/window/views editor/window/panels devices/input devices/roles
                                     PRIVATE_LIBS glfw::glfw epoxy::epoxy CLI11::CLI11)
