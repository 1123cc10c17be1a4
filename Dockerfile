# twindeck in a container of Debian 12: the first stage builds the Debian packages, the second installs them and nothing else.
#
#   docker build -t twindeck .
#   docker run --rm -u "$(id -u):$(id -g)" -v "$PWD:/study" twindeck new my_bridge
#   docker run --rm -u "$(id -u):$(id -g)" -v "$PWD:/study" twindeck run my_bridge
FROM debian:12 AS build
WORKDIR /source
# The packages alone first: they change less often than the sources, so a second build has them already.
COPY workflows/debian-packages.txt workflows/deps.sh workflows/
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends dpkg-dev file make && workflows/deps.sh
COPY . .
RUN make package

FROM debian:12
# Sources BSD-3-Clause; executables with CHOLMOD's supernodal module and FFTW GPL-2+ (packaging/copyright).
LABEL org.opencontainers.image.licenses="BSD-3-Clause AND GPL-2.0-or-later"
COPY --from=build /source/build/packages/ /packages/
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends /packages/twindeck_*.deb /packages/twindeck-data_*.deb && rm -rf /packages /var/lib/apt/lists/*
# Any user may run it: matplotlib keeps its cache of fonts where everybody may write.
ENV HOME=/tmp MPLCONFIGDIR=/tmp/matplotlib
WORKDIR /study
ENTRYPOINT ["twindeck"]
CMD ["--help"]
