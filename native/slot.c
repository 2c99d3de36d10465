#include "slot.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

static const double NS = 1e-9;

// The word is shared with other processes, which is what the cast to an atomic says.
static void store_word(slot_word * word, int64_t value)
{
  atomic_store_explicit((_Atomic int64_t *)&word->number, value, memory_order_release);
}

static int64_t open_slot(slot_word * words)
{
  const int64_t token = words[WORD_SEQUENCE].number | 1;
  atomic_store_explicit((_Atomic int64_t *)&words[WORD_SEQUENCE].number, token, memory_order_relaxed);
  atomic_thread_fence(memory_order_release);
  return token;
}

static void close_slot(slot_word * words, int64_t token)
{
  store_word(words + WORD_END, token + 1);
  store_word(words + WORD_SEQUENCE, token + 1);
}

static void empty_bank(slot_word * bank)
{
  for (int at = 0; at < BANK_WORDS; at += 2) {
    bank[at].real = INFINITY;
    bank[at + 1].real = -INFINITY;
  }
}

static void write_name(slot_word * words, const char * name)
{
  memcpy(words, name, strnlen(name, NAME_BYTES - 1));
}

void slot_begin(
  slot * in, int kind, const uint8_t gid[GID_BYTES], const char * topic, const char * node, const char * other)
{
  slot_word * const words = in->words;
  const int64_t token = open_slot(words);
  const int64_t generation = words[WORD_GENERATION].number;
  memset(words + 1, 0, (WORD_END - 1) * sizeof(*words));
  words[WORD_KIND].number = kind;
  words[WORD_GENERATION].number = generation + 1;
  words[WORD_BYTES].number = -1;
  words[WORD_LOST].number = -1;
  empty_bank(words + WORD_BANKS);
  memcpy(words + WORD_GID, gid, GID_BYTES);
  write_name(words + WORD_TOPIC, topic);
  write_name(words + WORD_NODE, node);
  write_name(words + WORD_OTHER, other);
  in->bank_time = -1;
  in->bank_at = WORD_BANKS;
  close_slot(words, token);
}

static void next_bank(slot * in, int64_t now)
{
  if (in->bank_time >= 0) {
    in->words[WORD_BANK].number++;
  }
  in->bank_time = now >> BANK_SHIFT;
  in->bank_at = WORD_BANKS + (int)(in->words[WORD_BANK].number % BANKS) * BANK_WORDS;
  empty_bank(in->words + in->bank_at);
}

static void moment(slot_word * words, int series, slot_word * extremes, int64_t ns)
{
  const double value = (double)ns * NS;
  words[series].number++;
  words[series + 1].real += value;
  words[series + 2].real += value * value;
  if (value < extremes[0].real) {
    extremes[0].real = value;
  }
  if (value > extremes[1].real) {
    extremes[1].real = value;
  }
}

void slot_count(slot * in, const message * what)
{
  slot_word * const words = in->words;
  const int64_t token = open_slot(words);
  if (what->now >> BANK_SHIFT != in->bank_time) {
    next_bank(in, what->now);
  }
  slot_word * const bank = words + in->bank_at;
  words[WORD_COUNT].number++;
  if (what->size >= 0) {
    words[WORD_BYTES].number = what->size + (words[WORD_BYTES].number > 0 ? words[WORD_BYTES].number : 0);
  }
  const int64_t last = words[WORD_LAST].number;
  words[WORD_LAST].number = what->when;
  if (last == 0) {
    words[WORD_FIRST].number = what->when;
  } else if (what->when >= last) {  // otherwise the clock was set back, and nobody knows how long it really took
    moment(words, WORD_PERIOD, bank + BANK_PERIOD, what->when - last);
  }
  if (what->latency != UNKNOWN_NS) {
    moment(words, WORD_LATENCY, bank + BANK_LATENCY, what->latency);
  }
  if (what->age != UNKNOWN_NS) {
    moment(words, WORD_AGE, bank + BANK_AGE, what->age);
  }
  if (what->processing != UNKNOWN_NS) {
    moment(words, WORD_PROCESSING, bank + BANK_PROCESSING, what->processing);
  }
  if (what->numbers != NULL) {
    words[WORD_LOST].number = what->numbers->lost;
    words[WORD_PENDING].number = what->numbers->pending;
    words[WORD_PENDING_SINCE].number = what->numbers->pending_since;
  }
  close_slot(words, token);
}

void slot_end(slot * in, int64_t now)
{
  const int64_t token = open_slot(in->words);
  in->words[WORD_ENDED].number = now;
  close_slot(in->words, token);
}

void slot_answered(slot * in, int64_t now, int64_t processing)
{
  slot_word * const words = in->words;
  const int64_t token = open_slot(words);
  if (now >> BANK_SHIFT != in->bank_time) {
    next_bank(in, now);
  }
  words[WORD_COUNT].number++;
  words[WORD_LAST].number = now;
  moment(words, WORD_PROCESSING, words + in->bank_at + BANK_PROCESSING, processing);
  close_slot(words, token);
}
