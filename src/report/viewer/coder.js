/* The other way round of coder.c, bit by bit: what its models have learnt stands in two arrays, each model from where it
 * begins in them. */
function makeCoder(bytes) {
    "use strict";
    const HALF = 32768, LEAST = 32, MOST_SEEN = 126, DOUBLE = 52, AT_ONCE = 16, WIDE = 0x1000000;
    const BYTE = 256, LENGTHS = 64, NUMBER = 64 + 1 + 64 * 4;
    let shares = new Uint16Array(1 << 16).fill(HALF), seen = new Uint8Array(1 << 16), used = 0;
    let low = 0, high = 0xffffffff, held = 0, at = 0;
    while (at < 4)
        held = (held << 8 | bytes[at++]) >>> 0;

    /* Room for so many models of a bit; where it begins. */
    function models(count) {
        const from = used;
        used += count;
        if (used > shares.length) {
            const [moreShares, moreSeen] = [new Uint16Array(2 * used).fill(HALF), new Uint8Array(2 * used)];
            moreShares.set(shares);
            moreSeen.set(seen);
            [shares, seen] = [moreShares, moreSeen];
        }
        return from;
    }

    function settle() {
        while (((low ^ high) & 0xff000000) === 0) {
            low = (low << 8) >>> 0;
            high = (high << 8 | 0xff) >>> 0;
            held = (held << 8 | bytes[at++]) >>> 0;
        }
    }

    function narrow(share) {
        const range = high - low;
        const middle = low + (range >>> 16) * share + (((range & 0xffff) * share) >>> 16), bit = held <= middle ? 1 : 0;
        if (bit)
            high = middle;
        else
            low = middle + 1;
        settle();
        return bit;
    }

    function bit(model) {
        let share = shares[model];
        const found = narrow(share);
        share += (((found ? 2 * HALF : 0) - share) / (seen[model] + 2)) | 0;
        shares[model] = share < LEAST ? LEAST : share > 2 * HALF - LEAST ? 2 * HALF - LEAST : share;
        if (seen[model] < MOST_SEEN)
            seen[model]++;
        return found;
    }

    function plain(count) {
        let value = 0;
        while (count > 0) {
            const range = high - low, taken = range < WIDE ? 1 : Math.min(count, AT_ONCE);
            count -= taken;
            if (taken === 1) {
                value = 2 * value + narrow(HALF);
                continue;
            }
            const step = range >>> taken, part = Math.floor((held - low) / step);
            low += step * part;
            high = low + step - 1;
            settle();
            value = value * 2 ** taken + part;
        }
        return value;
    }

    function tree(from, bits) {
        let node = 1;
        for (let k = 0; k < bits; k++)
            node = 2 * node + bit(from + node);
        return node - (1 << bits);
    }

    /* A number, as a BigInt where it has more than 52 bits; `coder.length`: how many it has. */
    function number(model) {
        const length = coder.length = tree(model, 6);
        if (!length)
            return 0;
        const below = bit(model + LENGTHS), behind = Math.min(length - 1, 2);
        const first = 1 << behind | tree(model + LENGTHS + 1 + 4 * length, behind), rest = length - 1 - behind;
        if (length > DOUBLE) {
            const upper = BigInt(plain(rest - 32)), size = BigInt(first) << BigInt(rest) | upper << 32n | BigInt(plain(32));
            return below ? -size : size;
        }
        const size = first * 2 ** rest + plain(rest);
        return below ? -size : size;
    }

    const coder = {length: 0, models, bit, number, byte: (model) => tree(model, 8), bytes: (count = 1) =>
        models(count * BYTE), numbers: (count = 1) => models(count * NUMBER), NUMBER, BYTE};
    return coder;
}
