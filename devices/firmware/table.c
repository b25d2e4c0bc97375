#include "devices/firmware/table.h"

#include "devices/firmware/period.h"

void fs_table_begin(struct fs_table* table, uint16_t period, uint16_t width) {
  table->period = period;
  table->width = width;
  table->triggers = 0;
  table->changes = 0;
  table->open_at_edge = 0;
  for (uint8_t eye = 0; eye < 2; ++eye) {
    table->open[eye] = 0;
    table->close[eye] = 0;
  }
}

enum fs_error fs_table_trigger(struct fs_table* table, uint16_t index, uint16_t at) {
  if (index >= FS_TRIGGERS_MAX || index > table->triggers) {
    return FS_RANGE;
  }
  table->trigger[index] = at;
  if (index == table->triggers) {
    ++table->triggers;
  }
  return FS_OK;
}

enum fs_error fs_table_shutter(struct fs_table* table, enum fs_eye eye, uint16_t open, uint16_t close) {
  if (open >= table->period || close >= table->period) {
    return FS_RANGE;
  }
  table->open[eye] = open;
  table->close[eye] = close;
  return FS_OK;
}

static bool is_open(const struct fs_table* table, uint8_t eye, uint16_t at) {
  const uint16_t open = table->open[eye];
  const uint16_t close = table->close[eye];
  return open <= close ? open <= at && at < close : at < close || open <= at;
}

static uint8_t open_eyes(const struct fs_table* table, uint16_t at) {
  return (uint8_t)((is_open(table, FS_LEFT, at) ? 1u : 0u) | (is_open(table, FS_RIGHT, at) ? 2u : 0u));
}

static void insert_change(struct fs_table* table, uint16_t at) {
  uint8_t place = table->changes;
  for (uint8_t i = 0; i < table->changes; ++i) {
    if (table->change_at[i] == at) {
      return;
    }
  }
  while (place && table->change_at[place - 1u] > at) {
    table->change_at[place] = table->change_at[place - 1u];
    --place;
  }
  table->change_at[place] = at;
  ++table->changes;
}

static bool order_changes(struct fs_table* table) {
  table->changes = 0;
  for (uint8_t eye = 0; eye < 2; ++eye) {
    if (table->open[eye] == table->close[eye]) {
      continue;
    }
    if (table->open[eye]) {
      insert_change(table, table->open[eye]);
    }
    if (table->close[eye]) {
      insert_change(table, table->close[eye]);
    }
  }
  table->open_at_edge = open_eyes(table, 0);
  bool apart = table->open_at_edge != 3u;
  for (uint8_t i = 0; i < table->changes; ++i) {
    table->change_to[i] = open_eyes(table, table->change_at[i]);
    apart = apart && table->change_to[i] != 3u;
  }
  return apart;
}

static bool triggers_fit(const struct fs_table* table) {
  uint32_t earliest = FS_FIRST_MIN;
  for (uint8_t i = 0; i < table->triggers; ++i) {
    if (table->trigger[i] < earliest) {
      return false;
    }
    earliest = (uint32_t)table->trigger[i] + table->width + FS_GAP_MIN;
  }
  return !table->triggers || earliest <= table->period;
}

enum fs_error fs_table_check(struct fs_table* table, uint16_t triggers) {
  if (triggers != table->triggers) {
    return FS_INCOMPLETE;
  }
  if (table->period < FS_PERIOD_MIN || table->period > FS_PERIOD_MAX || table->width < FS_WIDTH_MIN ||
      table->width > FS_WIDTH_MAX || !triggers_fit(table)) {
    return FS_RANGE;
  }
  return order_changes(table) ? FS_OK : FS_OVERLAP;
}
