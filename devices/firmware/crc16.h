#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// CRC-16/CCITT-FALSE: polynomial 1021, start FFFF, not reflected; of "123456789" it is 29B1.
#define FS_CRC16_START 0xFFFFu

uint16_t fs_crc16(uint16_t crc, uint8_t byte);

#ifdef __cplusplus
}
#endif
