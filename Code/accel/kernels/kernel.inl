// What the kernels of each set of instructions consist of: the queue, for rays of any kind, beams,
// for rays that go side by side, and bundles, for rays from one point. Included by its file inside
// its namespace, behind its registers; each of these needs what stands in front of it.

#include "accel/kernels/key_range.inl"

#include "accel/kernels/barycentrics.inl"

#include "accel/kernels/stack.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/queue_rays.inl"

#include "accel/kernels/root_boxes.inl"

#include "accel/kernels/queue_answers.inl"

#include "accel/kernels/edge_on.inl"

#include "accel/kernels/queue_exact.inl"

#include "accel/kernels/lane_hits.inl"

#include "accel/kernels/handful.inl"

#include "accel/kernels/queue_slots.inl"

#include "accel/kernels/ray_lists.inl"

#include "accel/kernels/queue_leaves.inl"

#include "accel/kernels/queue.inl"

#include "accel/kernels/beam_shape.inl"

#include "accel/kernels/beam.inl"

#include "accel/kernels/bundle_gaps.inl"

#include "accel/kernels/bundle_packets.inl"

#include "accel/kernels/bundle_rays.inl"

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/chord.inl"

#include "accel/kernels/bundle_keys.inl"

#include "accel/kernels/bundle_block.inl"

#include "accel/kernels/bundle_best.inl"

#include "accel/kernels/bundle_leaf.inl"

#include "accel/kernels/bundle.inl"
