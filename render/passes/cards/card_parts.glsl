// A part of a card that is sorted as a whole (SortedPart of sorting_gpu.h).
struct SortedPart {
  uint first_row, row_count;
  uint first_index, index_count;  // of the static order
  uint group;
};
