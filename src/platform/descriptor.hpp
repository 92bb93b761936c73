#pragma once

/// Functions for file descriptors, with one implementation for each operating system. A function that fails returns -1
/// and sets errno. Programs that this program starts do not inherit the descriptors.
#include <cstdint>

namespace contensou::platform {

int open_to_read(const char* path);
int open_to_write(const char* path);
int duplicate(int file);

/// Creates and opens a file that no other user can read.
/// @param name  path that ends in XXXXXX; unique characters replace these six before the file exists
int create_unfinished(char* name);

/// Removes a file, even if it is open. It may be called in a signal handler.
void remove_file(const char* path);

/// Renames a file. If a file with the new name exists, it is replaced.
int replace_file(const char* path, const char* target);

/// Returns true if a read would not wait. A read at the end of the file does not wait either.
bool is_ready(int file);

/// Reserves room on the disk, if the file system supports it.
int reserve(int file, std::uintmax_t bytes);

/// Sets the permissions of a file.
/// @param mode  as in stat(); without effect on a system without permissions
void set_permissions(int file, unsigned mode);

enum class Stream { output, error };

/// Returns true if a stream is a terminal.
bool is_terminal(Stream stream);

/// Prepares the standard streams. This must be called before any file is opened. A closed standard stream is replaced
/// by a descriptor that can be neither read nor written. Otherwise a file could get the number of standard error and
/// receive its messages. In Windows streams become binary and the console UTF-8.
void prepare_standard_streams();

}  // namespace contensou::platform
