// The program whose precompiled headers all tests use. It has no tests of its own.
