# The wire protocol's code is generated into the build tree; only our own code is held to our warnings.
find_package(Protobuf CONFIG QUIET)
if(NOT Protobuf_FOUND)
  find_package(Protobuf REQUIRED)
endif()
find_package(gRPC CONFIG REQUIRED)
find_program(FOCALSTAGE_PROTOC protoc REQUIRED)
find_program(FOCALSTAGE_GRPC_PLUGIN grpc_cpp_plugin REQUIRED)

set(rig_proto ${PROJECT_SOURCE_DIR}/io/protocol/focalstage/v1/rig.proto)
set(rig_out ${PROJECT_BINARY_DIR}/generated)
set(rig_stem ${rig_out}/focalstage/v1/rig)
file(MAKE_DIRECTORY ${rig_out})
add_custom_command(
  OUTPUT ${rig_stem}.pb.cc ${rig_stem}.pb.h ${rig_stem}.grpc.pb.cc ${rig_stem}.grpc.pb.h
  COMMAND ${FOCALSTAGE_PROTOC} -I ${PROJECT_SOURCE_DIR}/io/protocol --cpp_out=${rig_out} --grpc_out=${rig_out}
          --plugin=protoc-gen-grpc=${FOCALSTAGE_GRPC_PLUGIN} ${rig_proto}
  DEPENDS ${rig_proto} VERBATIM)
add_library(focalstage_rig_proto STATIC ${rig_stem}.pb.cc ${rig_stem}.grpc.pb.cc)
target_include_directories(focalstage_rig_proto SYSTEM PUBLIC ${rig_out})
target_link_libraries(focalstage_rig_proto PUBLIC gRPC::grpc++ protobuf::libprotobuf)
if(TARGET focalstage_io_protocol)
  get_target_property(rig_room_type focalstage_io_protocol TYPE)
  if(NOT rig_room_type STREQUAL "INTERFACE_LIBRARY")
    target_link_libraries(focalstage_io_protocol PUBLIC focalstage_rig_proto)
  endif()
endif()
