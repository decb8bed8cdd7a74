// The object whose precompiled headers the programs use.
