#pragma once

#include <cstdint>

/// What is done with the descriptors of files in a way of each system's own. A function that fails returns -1 and sets
/// errno. No program that is started inherits them.
namespace contensou::platform {

int open_to_read(const char* path);
int open_to_write(const char* path);
int duplicate(int file);

/// Creates and opens a file that nobody else can read.
/// @param name  its path, which ends in XXXXXX: they become what makes it the only one, before the file exists
int create_unfinished(char* name);

/// Removes a file, also one that is open. In a signal handler, too.
void remove_file(const char* path);

/// Gives a file another name, in place of the file that has it.
int replace_file(const char* path, const char* target);

/// Whether a read of what is there, or of its end, does not have to wait.
bool is_ready(int file);

/// Makes sure of the room on the disk, where the file system can.
int reserve(int file, std::uintmax_t bytes);

/// @param mode  as of stat(); where a system or a file system knows no permissions it has no effect
void set_permissions(int file, unsigned mode);

}  // namespace contensou::platform
