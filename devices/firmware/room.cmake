# The firmware's pure parts, for the host: what its tests hold. No program of ours links them.
set(firmware_pure)
foreach(source crc16 line period table command)
  list(APPEND firmware_pure ${PROJECT_SOURCE_DIR}/devices/firmware/${source}.c)
endforeach()
add_library(focalstage_firmware_pure STATIC ${firmware_pure})
target_include_directories(focalstage_firmware_pure PUBLIC ${PROJECT_SOURCE_DIR})
target_compile_options(focalstage_firmware_pure PRIVATE -std=c11 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
if(FOCALSTAGE_SANITIZE)
  target_compile_options(focalstage_firmware_pure PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
endif()
target_link_libraries(focalstage_devices_firmware INTERFACE focalstage_firmware_pure)

# The chip's own program: build/<preset>/firmware/focalstage-uno.elf and .hex.
set(firmware_folder ${PROJECT_SOURCE_DIR}/devices/firmware)
file(GLOB firmware_headers CONFIGURE_DEPENDS ${firmware_folder}/*.h)
set(firmware_sources ${firmware_pure} ${firmware_folder}/engine.c ${firmware_folder}/light.c
                     ${firmware_folder}/uart.c ${firmware_folder}/main.c)
set(firmware ${PROJECT_BINARY_DIR}/firmware/focalstage-uno)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/firmware)
add_custom_command(
  OUTPUT ${firmware}.elf ${firmware}.hex
  COMMAND ${FOCALSTAGE_AVR_GCC} -mmcu=atmega328p -DF_CPU=16000000UL -std=c11 -Os -flto -Wall -Wextra -Wshadow -Werror
          -I${PROJECT_SOURCE_DIR} ${firmware_sources} -o ${firmware}.elf
  COMMAND ${firmware_folder}/check-size ${FOCALSTAGE_AVR_SIZE} ${firmware}.elf
  COMMAND ${FOCALSTAGE_AVR_OBJCOPY} -O ihex -R .eeprom ${firmware}.elf ${firmware}.hex
  DEPENDS ${firmware_sources} ${firmware_headers} ${firmware_folder}/check-size
  COMMENT "Firmware of the trigger and shutter board"
  VERBATIM)
add_custom_target(firmware ALL DEPENDS ${firmware}.elf ${firmware}.hex)
