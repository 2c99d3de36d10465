/* crc8 0.3: the CRC of SMBus, polynomial 0x07. SPDX-License-Identifier: Apache-2.0 */
#include "crc8.h"

uint8_t crc8(const uint8_t *bytes, size_t count)
{
  uint8_t crc = 0;
  size_t i;
  int bit;
  for (i = 0; i < count; i++) {
    crc ^= bytes[i];
    for (bit = 0; bit < 8; bit++) {
      crc = (uint8_t)((crc & 0x80) ? (crc << 1) ^ 0x07 : crc << 1);
    }
  }
  return crc;
}
