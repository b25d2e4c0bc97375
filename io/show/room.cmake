target_compile_definitions(focalstage_io_show PRIVATE FOCALSTAGE_VERSION="${PROJECT_VERSION}")
