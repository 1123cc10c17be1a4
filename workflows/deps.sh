#!/bin/sh
# Says which packages twindeck needs, and installs those that are missing through apt (as root, or with sudo).
# Does nothing when all are there.
set -eu
list=$(dirname "$0")/debian-packages.txt
wanted=$(sed -e 's/#.*//' "$list" | tr -s ' \n' ' ')
missing=
for package in $wanted; do
  state=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [ "$state" = "install ok installed" ] || missing="$missing $package"
done
if [ "${1:-}" = "--list" ]; then
  for package in $wanted; do
    printf '%-28s %s\n' "$package" "$(dpkg-query -W -f='${Version}' "$package" 2>/dev/null || echo 'missing')"
  done
  exit 0
fi
if [ "${1:-}" = "--report" ]; then
  for package in $wanted; do
    printf '  %-28s %s\n' "$package" "$(dpkg-query -W -f='${Version}' "$package" 2>/dev/null | grep . || echo 'missing')"
  done
  optional=$(dirname "$0")/debian-packages-optional.txt
  if [ -f "$optional" ]; then
    echo "  optional:"
    sed -e '/^#/d' -e '/^$/d' "$optional" | while read -r package what; do
      state=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
      if [ "$state" = "install ok installed" ]; then state=$(dpkg-query -W -f='${Version}' "$package"); else state="not here: apt-get install --no-install-recommends $package"; fi
      printf '  %-28s %s (%s)\n' "$package" "$state" "$what"
    done
  fi
  # what `make paper` alone asks for
  printf '  %-28s %s\n' "LaTeX (optional)" "$(pdflatex --version 2>/dev/null | head -1 | grep . \
    || echo 'missing; make paper wants texlive-latex-base texlive-latex-recommended texlive-fonts-recommended')"
  if [ -z "$missing" ]; then
    echo "deps: all $(echo "$wanted" | wc -w) packages are installed, nothing to do"
  else
    echo "deps: missing:$missing; to install them by hand: apt-get install --no-install-recommends$missing"
  fi
fi
# What is missing but for CalculiX.
without() { for package in $missing; do [ "$package" = calculix-ccx ] || printf ' %s' "$package"; done; }
# CalculiX is compared with, by tests and benchmarks that leave themselves out without it. Debian 13 does not have it.
if [ -n "$missing" ] && apt-cache show make >/dev/null 2>&1 && ! apt-cache show calculix-ccx >/dev/null 2>&1; then
  missing=$(without)
fi
[ -n "$missing" ] || exit 0
if ! command -v apt-get >/dev/null 2>&1; then
  echo "deps: missing:$missing; this system has no apt-get, install them with its own package manager" >&2
  exit 2
fi
as_root=
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null 2>&1 || { echo "deps: missing:$missing; run 'make deps' as root, or install sudo" >&2; exit 2; }
  as_root=sudo
fi
echo "deps: installing with apt-get:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
apt-cache show calculix-ccx >/dev/null 2>&1 || { missing=$(without); echo "deps: calculix-ccx is not in this Debian and left out"; }
# apt says on its output where it is, as kind:package:per cent:what it does; a tenth at a time is passed on.
# shellcheck disable=SC2086  # the list is meant to be split
{ code=0; $as_root apt-get install -y -qq -o APT::Status-Fd=1 --no-install-recommends $missing || code=$?; echo "end:$code::"; } |
  {
    shown=
    while IFS=: read -r kind package percent what; do
      case $kind in
        end) exit "$package" ;;
        dlstatus) doing=fetching ;;
        pmstatus) doing=installing ;;
        *) continue ;;
      esac
      tenth="$doing ${percent%%.*}"
      tenth="${tenth%?}0"
      [ "$tenth" != "$shown" ] || continue
      shown=$tenth
      echo "deps: $doing, ${percent%%.*} %"
    done
  }
echo "deps: done"
