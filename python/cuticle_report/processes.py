"""Work that several processes share."""
import concurrent.futures
import multiprocessing
import os


def mapped(function, *arguments, least=2, chunk=1):
    """What the function gives for each of the arguments, in their order. This process does it alone where there are fewer than `least` of them or one processor, or where it is one of several already."""
    if min(map(len, arguments)) < least or (os.cpu_count() or 1) < 2 or multiprocessing.parent_process():
        return list(map(function, *arguments))
    with concurrent.futures.ProcessPoolExecutor(min(4, os.cpu_count()), multiprocessing.get_context("fork")) as pool:
        return list(pool.map(function, *arguments, chunksize=chunk))
