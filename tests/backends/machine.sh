#!/bin/bash
# Runs a command on a machine that has SocketCAN: machine.sh COMMAND [ARGUMENT...]
# vcan0 is a virtual CAN; can0 and can1 are two SJA1000 controllers on one emulated bus, at 500 kbit/s.
# The machine is Debian's kernel under qemu, emulated in software; it sees this system's files and writes none.
set -euo pipefail

PACKAGES="linux-image-amd64 qemu-system-x86 busybox-static cpio kmod iproute2"
MODULES="virtio_pci 9pnet_virtio 9p vcan can-raw kvaser_pci"
MEMORY_MB=2048
LIMIT_S=1500

release=$(ls /lib/modules 2>/dev/null | sort --version-sort | grep -e -amd64 | tail -1 || true)
has() { for program in "$@"; do command -v "$program" >/dev/null || return 1; done; }
if [ ! -e "/boot/vmlinuz-$release" ] || ! has qemu-system-x86_64 busybox cpio modprobe ip; then
    echo "skipped: SocketCAN under qemu needs these of Debian's packages: $PACKAGES"
    exit 0
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/root/bin" "$folder/root/modules" "$folder/root/system"
cp "$(command -v busybox)" "$folder/root/bin/busybox"
for module in $MODULES; do modprobe --set-version "$release" --show-depends "$module"; done |
    awk '$1 == "insmod" && !seen[$2]++ { print $2 }' >"$folder/paths"
cp $(cat "$folder/paths") "$folder/root/modules"
sed 's|.*/||' "$folder/paths" >"$folder/root/modules/order"

{
    echo "cd $(printf '%q' "$PWD")"
    echo "export HOME=/run/tmp TMPDIR=/run/tmp PYTHONDONTWRITEBYTECODE=1 PATH=$PATH"
    echo "ip link add vcan0 type vcan && ip link set vcan0 up"
    for name in can0 can1; do
        echo "ip link set $name type can bitrate 500000 restart-ms 100"
        echo "ip link set $name txqueuelen 100 up"
    done
    printf '%q ' "$@"
} >"$folder/root/command"

cat >"$folder/root/init" <<'INIT'
#!/bin/busybox sh
/bin/busybox --install -s /bin
mkdir -p /proc
mount -t proc proc /proc
for module in $(cat /modules/order); do insmod "/modules/$module"; done
mount -t 9p -o ro,trans=virtio,version=9p2000.L,cache=loose,msize=524288 system /system
mount -t proc proc /system/proc
mount -t sysfs sysfs /system/sys
mount -t devtmpfs dev /system/dev
mount -t tmpfs tmp /system/run
mkdir -p /system/run/tmp
cp /command /system/run/command
chroot /system /bin/bash /run/command
echo "exit status $?"
poweroff -f
INIT
chmod +x "$folder/root/init"
(cd "$folder/root" && find . | cpio --quiet --create --format=newc) >"$folder/initramfs"

nice -n 5 timeout "$LIMIT_S" qemu-system-x86_64 -accel tcg -cpu max -m "$MEMORY_MB" -smp 1 \
    -nodefaults -no-reboot -display none -serial stdio \
    -object can-bus,id=bus -device kvaser_pci,canbus=bus -device kvaser_pci,canbus=bus \
    -virtfs local,path=/,mount_tag=system,security_model=none,readonly=on,multidevs=remap \
    -kernel "/boot/vmlinuz-$release" -initrd "$folder/initramfs" \
    -append "console=ttyS0 quiet edd=off panic=-1" </dev/null | sed --unbuffered "s/\r$//" | tee "$folder/said"
grep -q '^exit status 0$' "$folder/said"
