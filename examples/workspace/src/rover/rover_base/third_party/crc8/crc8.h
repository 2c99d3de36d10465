/* crc8 0.3: the CRC of SMBus, polynomial 0x07. SPDX-License-Identifier: Apache-2.0 */
#ifndef CRC8_H
#define CRC8_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

uint8_t crc8(const uint8_t *bytes, size_t count);

#ifdef __cplusplus
}
#endif

#endif
