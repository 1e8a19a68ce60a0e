# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
# cmake -DBUILD=<build folder of motex> -DSOURCE=<this folder> -DWORK=<scratch> -DCXX=<compiler> -DFLAGS=<its flags> -P check.cmake
# Installs motex under a prefix of its own, builds the consumer against nothing but that prefix, runs it.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
