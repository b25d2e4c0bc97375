# The firmware's pure parts, for the host: what its tests hold. No program of ours links them.
add_library(focalstage_firmware_pure STATIC devices/firmware/crc16.c devices/firmware/line.c devices/firmware/period.c
            devices/firmware/table.c)
target_include_directories(focalstage_firmware_pure PUBLIC ${PROJECT_SOURCE_DIR})
target_compile_options(focalstage_firmware_pure PRIVATE -std=c11 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
if(FOCALSTAGE_SANITIZE)
  target_compile_options(focalstage_firmware_pure PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
endif()
target_link_libraries(focalstage_devices_firmware INTERFACE focalstage_firmware_pure)
