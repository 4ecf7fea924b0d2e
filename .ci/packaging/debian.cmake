# Debian packages by CPack, one of each component: ./run package. debian_files.cmake finishes their files.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Whoever makes packages for others states whom to write to, as with all Debian tools.
set(maker "The viscard authors")
set(address viscard@viscard.invalid)
if(DEFINED ENV{DEBFULLNAME})
  set(maker "$ENV{DEBFULLNAME}")
endif()
if(DEFINED ENV{DEBEMAIL})
  set(address "$ENV{DEBEMAIL}")
endif()
set(CPACK_PACKAGE_CONTACT "${maker} <${address}>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own first line
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${packaging}/debian_files.cmake)
set(CPACK_COMPONENTS_ALL runtime development documentation)

# debian_package(COMPONENT NAME SECTION SYNOPSIS PARAGRAPH)
function(debian_package component name section synopsis paragraph)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${synopsis}\n${paragraph}" PARENT_SCOPE)
endfunction()

set(about "viscard drives an indentation rig, fits Young's modulus and a Prony series\n\
with honest intervals, writes material cards for other solvers, and answers\n\
scenes of pillar sensors with error estimates.")
debian_package(runtime viscard science "soft polymers from a load cell to a validated simulation"
  "${about}\n.\nThis package has the program, its man pages, a demo and example scenes, and\na page for each part with equations, file formats and recipes.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Plots are drawn by gnuplot; fits, cards and scenes need none.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot-x11 | gnuplot-qt")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "paraview")

debian_package(development libviscard-dev libdevel "library of viscard for C++ programs"
  "${about}\n.\nThis package has the static library, its headers and an example, for CMake and\npkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS  # what viscardConfig.cmake and viscard.pc ask for
    "libboost-program-options-dev, libceres-dev, libcpp-httplib-dev, libeigen3-dev, libfmt-dev, libgoogle-glog-dev, libnlopt-dev,\
 libhdf5-dev, libmatio-dev, libpugixml-dev, libserial-dev, libsqlite3-dev, libssl-dev, libtomlplusplus-dev, libudunits2-dev, libzip-dev,\
 nlohmann-json3-dev, pkg-config, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "viscard-doc")

debian_package(documentation viscard-doc doc "documentation of the library of viscard"
  "${about}\n.\nThis package has the documentation of the library's headers.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

# io/cli/mpi installs its program as component mpi if it is built.
if(TARGET viscard_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  debian_package(mpi viscard-mpi science "viscard on many machines at once"
    "${about}\n.\nThis package has viscard-mpi, which answers a scene at many values of its\nparameters on many machines by MPI.")
  set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS "openmpi-bin, viscard")  # mpirun, the scenes of its examples
  set(CPACK_DEBIAN_MPI_PACKAGE_SUGGESTS "slurm-client")
endif()

# io/python installs its module as component python if it is built.
if(TARGET viscard_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  debian_package(python python3-viscard python "viscard for Python programs"
    "${about}\n.\nThis package has the Python module, whose arrays are those of numpy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "viscard")  # the files of its examples
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")
endif()
include(CPack)
