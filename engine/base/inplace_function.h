// A callable held in place: like std::function, but it never allocates, and a callable that does not fit does not compile.
#pragma once

#include "base/check.h"

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace antumbra {

template <class Signature, size_t kCapacity>
class InplaceFunction;

/// Holds callables of up to `kCapacity` bytes that can be called while const. Moves, does not copy.
template <class Result, class... Args, size_t kCapacity>
class InplaceFunction<Result(Args...), kCapacity>
{
public:
    InplaceFunction() = default;

    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, InplaceFunction> && std::is_invocable_r_v<Result, const std::decay_t<F>&, Args...>)
        InplaceFunction(F&& callable)
        : operations_(&kOperations<std::decay_t<F>>)
    {
        using Callable = std::decay_t<F>;
        static_assert(sizeof(Callable) <= kCapacity, "the callable captures more than the function holds");
        static_assert(alignof(Callable) <= alignof(std::max_align_t), "the callable is aligned more strictly than the storage");
        static_assert(std::is_nothrow_move_constructible_v<Callable>, "a callable that moves without throwing");
        ::new (static_cast<void*>(storage_)) Callable(std::forward<F>(callable));
    }

    InplaceFunction(InplaceFunction&& other) noexcept { take(other); }
    InplaceFunction& operator=(InplaceFunction&& other) noexcept
    {
        if (this != &other) {
            clear();
            take(other);
        }
        return *this;
    }
    ~InplaceFunction() { clear(); }

    explicit operator bool() const { return operations_ != nullptr; }

    Result operator()(Args... args) const
    {
        check(operations_ != nullptr, "a function that holds a callable");
        return operations_->call(storage_, std::forward<Args>(args)...);
    }

private:
    struct Operations
    {
        Result (*call)(const std::byte* storage, Args&&... args);
        void (*relocate)(std::byte* to, std::byte* from) noexcept;
        void (*destroy)(std::byte* storage) noexcept;
    };

    template <class Callable>
    static Callable& held(std::byte* storage)
    {
        return *std::launder(reinterpret_cast<Callable*>(storage));
    }

    template <class Callable>
    static constexpr Operations kOperations{
        [](const std::byte* storage, Args&&... args) -> Result {
            return (*std::launder(reinterpret_cast<const Callable*>(storage)))(std::forward<Args>(args)...);
        },
        [](std::byte* to, std::byte* from) noexcept {
            ::new (static_cast<void*>(to)) Callable(std::move(held<Callable>(from)));
            held<Callable>(from).~Callable();
        },
        [](std::byte* storage) noexcept { held<Callable>(storage).~Callable(); },
    };

    void take(InplaceFunction& other) noexcept
    {
        operations_ = std::exchange(other.operations_, nullptr);
        if (operations_)
            operations_->relocate(storage_, other.storage_);
    }

    void clear() noexcept
    {
        if (const Operations* operations = std::exchange(operations_, nullptr))
            operations->destroy(storage_);
    }

    alignas(std::max_align_t) std::byte storage_[kCapacity];
    const Operations* operations_ = nullptr;
};

} // namespace antumbra
