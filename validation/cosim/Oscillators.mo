package Oscillators "Two masses on springs, coupled by a spring and damper; cut in two, and whole"
  model Left "A mass on its own spring and damper, pushed by a force"
    parameter Real m(unit="kg") = 1;
    parameter Real k(unit="N/m") = 10;
    parameter Real d(unit="N.s/m") = 0.1;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=1, fixed=true);
    output Real v(unit="m/s", start=0, fixed=true);
  equation
    der(x) = v;
    m*der(v) = F - k*x - d*v;
  end Left;

  model Right "The other mass, with the spring and damper between both: takes the left one's motion, gives the force"
    parameter Real m(unit="kg") = 2;
    parameter Real k(unit="N/m") = 40;
    parameter Real d(unit="N.s/m") = 0.3;
    parameter Real c(unit="N/m") = 30 "Between both";
    parameter Real b(unit="N.s/m") = 0.5 "Between both";
    input Real x_l(unit="m", start=0);
    input Real v_l(unit="m/s", start=0);
    output Real F(unit="N");
    output Real x(unit="m", start=0, fixed=true);
    Real v(unit="m/s", start=0, fixed=true);
  equation
    F = c*(x - x_l) + b*(v - v_l);
    der(x) = v;
    m*der(v) = -F - k*x - d*v;
  end Right;
end Oscillators;
