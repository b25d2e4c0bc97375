# The kernel's second copy; -mfma stays off with it, and contraction is off everywhere.
set_source_files_properties(${PROJECT_SOURCE_DIR}/core/compile/kernel_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
