// FunctionRef: a function that is called before the call that it is given to returns. It refers to
// the object that it was made of, takes no memory, and must not be kept: a lambda that a variable
// of this type is made of is gone at the end of that statement.
#pragma once

#include <type_traits>
#include <utility>

template <class Signature> class FunctionRef;

template <class Result, class... Args> class FunctionRef<Result(Args...)> {
public:
    FunctionRef() = default; // none; not to be called
    // The constraint keeps copies apart, which clang-tidy 14 does not see.
    // NOLINTBEGIN(bugprone-forwarding-reference-overload)
    template <class Function>
    requires(!std::is_same_v<std::remove_cvref_t<Function>, FunctionRef> &&
             std::is_invocable_r_v<Result, Function&, Args...>) FunctionRef(Function&& function)
        : object_(const_cast<void*>(static_cast<const void*>(&function))),
          call_([](void* object, Args... args) -> Result {
              return (*static_cast<std::remove_reference_t<Function>*>(object))(
                  std::forward<Args>(args)...);
          }) {}
    // NOLINTEND(bugprone-forwarding-reference-overload)

    Result operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }
    explicit operator bool() const { return call_ != nullptr; }

private:
    void* object_ = nullptr;
    Result (*call_)(void*, Args...) = nullptr;
};
