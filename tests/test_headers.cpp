// Holds nothing: CMake wants a source to compile headers for.
