// The counter file of this process, which ends with the process.

#ifndef ROSLENS_COUNTER_FILE_H
#define ROSLENS_COUNTER_FILE_H

#include <stdatomic.h>
#include <stdbool.h>

#include "counter_layout.h"

// Whether there is a file and this process may write it. A child of a fork may not: its parent counts in it.
extern atomic_bool counter_file_open;

// Make the file, once. Errors are reported on standard error, once, and leave it closed.
void open_counter_file(void);

// Write in words what this library does.
void say(const char * state);

// Return the words of a slot that was never used; NULL where all were, or memory for it is not to be had.
slot_word * fresh_slot(void);

// Show the fresh slot to readers, after it has been filled in.
void show_slot(void);

// Count an endpoint that found no slot.
void count_overflow(void);

#endif
