// What the program needs of the file system beside <cstdio> and <filesystem>.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

// Why this process may not write to the file, or into the folder, of that name, in the words of the
// system; empty where it may. Says nothing of the room on the disk, and leaves both as they are.
std::string whyNotWritable(const std::string& name);

// The bytes of a file from `first` on. Several threads may read one file at once; where the stream
// stands afterwards is left open. Returns how many bytes came: fewer than asked for at the end of
// the file and after an error, none where the system has no such call.
std::size_t readAt(std::FILE* file, std::uint64_t first, std::span<char> to);

// A number that no other running program of this machine has, the same at every call: for the names
// of temporary files.
unsigned long processNumber();
