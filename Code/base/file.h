// Whole files: read into memory, written so that a half-written file never has the final name.
// Knows nothing about what the bytes mean; "-" for stdin and stdout is the caller's business.
#pragma once

#include "base/file_text.h"
#include "base/function_ref.h"
#include "base/in_order.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// All bytes of a regular file or pipe. Fails with ErrorKind::Input: the name and the system's
// reason.
std::vector<std::uint8_t> readWholeFile(const std::string& fileName);
// The same as text, read by several threads where it is long (0: as many as the machine has).
FileText readWholeText(const std::string& fileName, int threads = 1);

// Writes a temporary file in the same folder and renames it; an existing file keeps its content
// until then. What is no regular file (/dev/null, a pipe) is written to directly. One write at a
// time: threads wait for each other. Fails with ErrorKind::Output and leaves no temporary file.
void writeFileAtomically(const std::string& fileName, std::span<const std::uint8_t> bytes);
// The same for bytes that are made meanwhile: produce(write) gives them to `write` one piece after
// the other, from any thread.
using ByteSource = FunctionRef<void(ByteSink write)>;
void writeFileAtomically(const std::string& fileName, ByteSource produce);

// The temporary file that exists right now, nullptr when there is none. Safe in a signal handler,
// which may remove it before the program ends.
const char* pendingTemporaryFile();
